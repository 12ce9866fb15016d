(** Configurations as words ({!Layout}). A configuration that executes nothing is kept as it is, and numbered. *)

open Dolphin_semantics
open Dolphin_environment

type t

val create :
  ?find_symmetry:(Residual.t -> Surroundings.t -> Task_group.t option) ->
  ?canonical:(Configuration.t -> Environment.t -> Configuration.t * Environment.t) ->
  ?watched:int -> Components.t -> Memoised_steps.t -> t
(** [find_symmetry r s] is what can change places in [r], which is about to be executed where [s] is shared: nothing by
    default. [canonical c e] is the form in which [c] with [e] is kept, if it executes nothing: by default itself.
    [watched] is as for {!Layouts.create}. *)

val shapes : t -> Layouts.t

val check_fit : t -> unit
(** @raise Layouts.Outgrown if some number does not fit its field. *)

val widened : t -> watched:int -> int array -> int array -> unit
(** See {!Layouts.widened}. *)

val write : t -> int array -> Rule.t list -> Configuration.t -> Environment.t -> int
(** [write t key rules c e] puts the words of [c] with [e], which a step by [rules] led to, into [key]. The result is a
    number for the place of the script: below 0 where a task executes, and otherwise that of the configuration.
    @raise Layouts.Outgrown *)

val write_parts : t -> int array -> Layout.frame -> Component.part Component.tree list -> int -> unit
(** [write_parts t key f children s] puts the words of [children] with shared [s] into [key].
    @raise Layouts.Outgrown *)

val read : t -> int array -> Configuration.t * Environment.t
(** [read t key] is what [key] stands for. *)

val residual : Layout.t -> int array -> Layout.place -> Residual.t
(** [residual s key p] is what stands at [p] in the state [key] of shape [s]. *)

val part : Layout.t -> int array -> int -> Component.part
(** [part s key i] is the part at position [i]. *)

(** {1:wholes Configurations that execute nothing} *)

val whole : t -> Rule.t list -> Configuration.t -> Environment.t -> int
(** [whole t rules c e] is the number of [c] with [e]. *)

val value : t -> int -> Configuration.t * Environment.t
val broken : t -> int -> Property.t option
(** [broken t n] is what reaching configuration [n] breaks. *)

val write_whole : t -> int array -> int -> unit
val count_wholes : t -> int
