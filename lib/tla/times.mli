(** How long what a program waits for takes, as constants of [spec/Timed.tla]. *)

open Dolphin_semantics
module Durations = Dolphin_time.Durations

type t = {
  durations : Durations.t;
  tick : int;  (** in milliseconds *)
  horizon : int;  (** the number of ticks that are explored *)
}

val tick : Durations.t -> faults:Dolphin_environment.Faults.t -> plans:string list -> Core.program -> World.t -> int
(** [tick d ~faults ~plans p w] is the longest tick, in milliseconds, of which all durations of [plans] on the
    vehicles of [w] are multiples, each date that [p] names, and the time that links may be silent and picks wait, if
    [faults] may make them, or links come and go; a second, without any such time. *)

val definitions :
  t -> faults:Dolphin_environment.Faults.t -> plans:string list -> Core.program -> World.t -> (string * string) list
(** [definitions t ~faults ~plans p w] is the constants that are not numbers: for each its name with its parameters,
    and its definition. A plan outside of [plans] takes the time of an unknown plan. *)

val values : t -> (string * int) list
(** The constants that are numbers. *)
