(** Configurations as vectors of words ({!Layout}). A configuration that executes nothing, the script's turn or its
    end, is kept as it is, and numbered. *)

open Dolphin_semantics
open Dolphin_environment

type t

val create :
  ?spare_bits:int ->
  ?find_symmetry:(Residual.t -> Surroundings.t -> Task_group.t option) ->
  ?canonical:(Configuration.t -> Environment.t -> Configuration.t * Environment.t) ->
  Components.t -> Surroundings.Numbers.t -> Core.program -> t
(** [spare_bits] is as for {!Layouts.create}. [find_symmetry r s] is the symmetry of [r], about to be executed in
    shared state [s]: none by default. [canonical c e] is the form in which [c] with [e] is kept if it executes
    nothing, or a task that begins: itself by default. *)

val layouts : t -> Layouts.t
(** The layouts of executing configurations so far. *)

val outside : t -> int -> Environment.t
(** [outside t n] is the environment's memory in the shared part with number [n]. *)

val shareds : t -> Surroundings.Numbers.t
(** The numbers of shared parts. *)

val frame : t -> Machine.t -> Task_group.t option -> Layout.frame
(** [frame t m g] is the frame of layouts in which [m] waits for a task with the symmetry [g]. *)

val check_fit : t -> unit
(** @raise Layouts.Outgrown if some number does not fit its field. *)

val widen : t -> reserved:int -> int array -> int array -> unit
(** See {!Layouts.widen}. *)

val write : t -> int array -> Rule.t list -> Configuration.t -> Environment.t -> int
(** [write t key rules c e] puts the words of [c] with [e], which a step by [rules] led to, into [key]. The result is a
    number for the place of the script: below 0 where a task executes, and otherwise that of the configuration.
    @raise Layouts.Outgrown *)

val write_components : t -> int array -> Layout.frame -> Component.component Component.tree list -> int -> unit
(** [write_components t key f children s] puts the words of [children] with shared state number [s] into [key].
    @raise Layouts.Outgrown *)

val executing : Layout.t -> int array -> Residual.t * Core.platform_task Vehicle_map.t
(** [executing l key] is the residual of the state [key] with layout [l], and A. *)

val read : t -> int array -> Configuration.t * Environment.t
(** [read t key] is the state encoded by [key]. *)

val residual : Layout.t -> int array -> Layout.place -> Residual.t
(** [residual l key p] is the residual at [p] in the state [key] of layout [l]. *)

val component : Layout.t -> int array -> int -> Component.component
(** [component l key i] is the component at position [i]. *)

(** {1:scripts Configurations that execute nothing} *)

val script_number : t -> Rule.t list -> Configuration.t -> Environment.t -> int
(** [script_number t rules c e] is the number of [c] with [e], which a step by [rules] led to. *)

val script : t -> int -> Configuration.t * Environment.t
(** [script t n] is configuration [n]. *)

val broken : t -> int -> Property.t option
(** [broken t n] is the property that reaching configuration [n] breaks. *)

val write_script : t -> int array -> int -> unit
(** [write_script t key n] puts the words of configuration [n] into [key]. *)
