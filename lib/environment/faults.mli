(** The possible faults in an explored world, beyond those of its scenario: [--faults]. *)

(** How often something may happen in one run. *)
type limit = Never | At_most of int | Any_number

val is_possible : limit -> bool
(** Whether it may happen at all. *)

type t = {
  fail : limit;
  (** failures of platform tasks that would succeed, or might. If not [Never], every task that may succeed may fail
      too, up to this number of times in one run. *)
  loss : limit;
  (** how often the connection of a vehicle that runs a task may be lost for longer than its timeout. It is counted once
      until the vehicle is heard of again. *)
  join : limit;  (** how many vehicles of one run may be late, or missing, when they are picked *)
  interrupt : bool;  (** whether a person may interrupt the program, at any time: no run is interrupted twice *)
}

val none : t
(** No faults but those of the scenario. *)

val all : t
(** ["all"]: any number of failures, losses, and vehicles that are late or missing. *)

val of_string : string -> (t, string) result
(** [of_string text] is the faults that [text] spells: ["fail"], ["fail=1,loss=2"], ["all,interrupt"]; or the error
    in it. *)

val pp : Format.formatter -> t -> unit
(** As {!of_string} reads it. *)
