(** The subset construction of an automaton, on the fly: after each letter of a word, the set of states in which the
    automaton's runs over the word can be. Sets are numbered from 0 as they are found; letters are numbers too.

    {[
      open Dolphin_ltl

      (* The letter 0 is a position at which the program is idle, 1 one at which it is done. *)
      let monitor =
        let holds letter proposition = proposition = "done" && letter = 1 in
        Monitor.create ~holds (Automaton.of_formula (Result.get_ok (Formula.of_string "F done")))

      let next = Monitor.next monitor ~give:ignore

      let () =
        let idle = next Monitor.start 0 in
        assert (not (Monitor.is_certain monitor idle) && not (Monitor.stays monitor idle 0));
        assert (Monitor.is_certain monitor (next idle 1))
    ]} *)

type t

val create : holds:(int -> 'p -> bool) -> 'p Automaton.t -> t
(** [holds l p] is whether [p] holds where letter [l] stands. *)

val start : int
(** Before the first letter. *)

val next : t -> give:(unit -> unit) -> int -> int -> int
(** [next m ~give s l] is the set after [s] and letter [l], or [-1] if it is empty: however the word goes on, it is
    not accepted. [give ()] is called before a set gets a number; its exceptions pass through, and the set has none. *)

val count : t -> int
(** Sets so far. *)

val is_certain : t -> int -> bool
(** If [is_certain m s], a word in [s] is accepted however it goes on. The converse does not hold. *)

val stays : t -> int -> int -> bool
(** [stays m s l] is whether a word in [s] is accepted if it goes on with the letter [l] without end. *)

(** {1:runs Runs of the automaton} *)

val automaton_states : t -> int
(** As {!Automaton.states}. *)

val members : t -> int -> int list
(** [members m s] is the states in [s]. *)

val after : t -> int -> int -> int list
(** [after m q l] is the states after [q] and letter [l]. *)

val acceptance_sets : t -> int
(** As {!Automaton.acceptance_sets}. *)

val is_in : t -> int -> int -> bool
(** As in {!Automaton}. *)

val component : t -> int -> int
(** States [q] and [q'] can be on one accepting cycle only if [component m q] and [component m q'] are equal and not
    [-1]. *)
