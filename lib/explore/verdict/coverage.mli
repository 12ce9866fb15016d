(** Which code of a program some run has reached. *)

open Dolphin_semantics

type t

val create : unit -> t

val run : t -> Core.closure -> unit
(** The closure has been run. *)

val start : t -> Core.platform_task -> unit
(** The task has been started. *)

val is_run : t -> int -> bool
(** Of code, by the number of its lambda. *)

val reach : t -> Core.site -> unit
(** A task at that site has been started. *)

val reach_code : t -> int -> unit
(** The code with this number has been run. *)

val transition : t -> Configuration.t -> Transition.t -> unit
(** The script has made this transition from there. *)

(** A piece of a program. *)
type piece = { site : Core.site; what : string  (** ["action"], ["task"] *) }

val unreached : t -> Core.program -> piece list
(** In the order of the text: platform tasks that no vehicle starts; code of actions, conditions, guards, [until],
    [during] and [onError] that is not run; and of the script outside of functions and closures, what others would see
    it do ([execute], [post], [message], ...) if it does not. *)
