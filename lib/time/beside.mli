(** What other processes work out beside this one, by numbers from 0 on. *)

module Limits = Dolphin_checker.Limits

type 'a t

val start : workers:int -> Limits.t -> count:int -> (Limits.t -> int -> 'a) -> 'a t option
(** [start ~workers limits ~count f] works out [f limits' 0] to [f limits' (count - 1)] in so many processes: [limits']
    are [limits] without reports. What [f] gives is as {!Dolphin_processes.Workers.start} says. [None] if the system
    makes none. *)

val so_far : 'a t -> (int * 'a) list * Limits.bound option
(** [so_far b] is what can be told at once of what {!await} will say. *)

val await : 'a t -> started:float -> Limits.t -> Limits.measures -> string -> (int * 'a) list * Limits.bound option
(** [await b ~started limits m phase] is what was found, by number, and why it is not all, if so: an interruption, or a
    process ended early. Meanwhile it reports [phase], which is of what [started] then, with [m]. *)

val stop : 'a t -> unit
(** Ends these processes. *)
