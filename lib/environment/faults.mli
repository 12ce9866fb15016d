(** What may go wrong in a world that is explored, as [--faults] says. *)

type t = {
  fail : Environment.limit;  (** tasks that fail though the fleet does not say so *)
  loss : Environment.limit;  (** lost connections *)
  join : Environment.limit;  (** vehicles that come late, or never *)
  interrupt : bool;  (** whether a person may interrupt the program, at any time: no run is interrupted twice *)
}

val none : t

val of_string : string -> (t, string) result
(** [of_string text] is what [text] spells: ["fail"], ["fail=1,loss=2"], ["all,interrupt"]; or what is wrong with it. *)

val add_to : Environment.options -> t -> Environment.options
(** [add_to o faults] is [o], with these faults instead of its losses, latecomers and interruptions, and with failures of
    every task that may succeed, if there are to be any ({!Environment.failing}). *)

val pp : Format.formatter -> t -> unit
(** As {!of_string} reads it. *)
