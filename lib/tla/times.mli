(** How long what a program waits for takes, as constants of [spec/Timed.tla]. *)

open Dolphin_semantics
module Durations = Dolphin_time.Durations

type t = {
  durations : Durations.t;
  tick : int;  (** in milliseconds *)
  horizon : int;  (** so many ticks are looked at *)
}

val tick : Durations.t -> faults:Dolphin_environment.Faults.t -> plans:string list -> Core.program -> World.t -> int
(** [tick d ~faults ~plans p w] is the longest tick, in milliseconds, of which all that [plans] take on the vehicles
    of [w] is a whole number, each date that [p] names, and how long links may be silent and picks wait, if [faults] may
    make them, or links come and go; a second, if there is no such time. *)

val definitions :
  t -> faults:Dolphin_environment.Faults.t -> plans:string list -> Core.program -> World.t -> (string * string) list
(** [definitions t ~faults ~plans p w] is the constants that are no numbers: for each its name with its
    parameters, and what it is. A plan that is none of [plans] takes what one takes that nobody has heard of. *)

val values : t -> (string * int) list
(** The constants that are numbers. *)
