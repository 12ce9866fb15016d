(** Chance that can be had again: numbers drawn from what they are drawn for, and from nothing else. So one vehicle's
    luck does not depend on how many draws others made before, and a run is the same on every version of the compiler
    (whose own generator changed with OCaml 5). *)

(** What is decided. *)
type question = Length | Failure | Moment  (** of the failure *) | Course

val share : seed:int -> vehicle:string -> start:int -> question -> float
(** [share ~seed ~vehicle ~start q] is a number from 0 up to but without 1, evenly spread over seeds, over vehicles,
    over [start] (the how manieth task of the vehicle it is), and over questions. *)

val between : float -> float -> float -> float
(** [between least most share] is the number that lies at [share] from [least] to [most]. *)
