(** The code of a program that some run has reached. *)

open Dolphin_semantics

type t

val create : unit -> t
(** Nothing is reached. *)

val copy : t -> t
(** [copy t] is what [t] has now; later changes of one leave the other as it is. *)

val add : t -> t -> unit
(** [add t t'] adds to [t] what [t'] has. *)

val run : t -> Core.closure -> unit
(** The closure has been run. *)

val start : t -> Core.platform_task -> unit
(** The task has been started. *)

val is_run : t -> int -> bool
(** [is_run t i] is whether the code of the lambda with number [i] has been run. *)

val reach : t -> Core.site -> unit
(** The task at that site has been started. *)

val reach_code : t -> int -> unit
(** The code with this number has been run. *)

val transition : t -> Configuration.t -> Transition.t -> unit
(** The script has made this transition from there. *)

(** A piece of a program. *)
type piece = { site : Core.site; what : string  (** ["action"], ["task"] *) }

val unreached : t -> Core.program -> piece list
(** The pieces that no run has reached, in the order of the text. The pieces are platform tasks that no vehicle
    starts; code of actions, conditions, guards, [until], [during] and [onError] that is not run; and visible
    operations of the script outside of functions and closures ([execute], [post], [message], ...). *)
