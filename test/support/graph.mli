(** The state graph of a small program, state by state: the reference of the explorer, and the object of laws. *)

open Dolphin_semantics

type t = {
  states : Configuration.t array;  (** the first is the initial one *)
  edges : (Transition.t * int) list array;  (** by state: each transition and the state it leads to *)
}

val outcomes :
  ?failures:bool -> ?interruption:bool -> Core.program -> World.t -> Configuration.t -> Transition.t list
(** [outcomes p w c] is all that may happen in [c]: its own steps, the events it awaits, with [failures] also failures
    of vehicles and of those who should answer (by default there are some), with [interruption] also Ctrl-C (by default
    not). An [ask] is answered {!Generate.answer}. *)

val explore : ?limit:int -> ?failures:bool -> Core.program -> World.t -> t option
(** [explore p w] is the graph of all states of [p], or [None] if there are more than [limit], 2,000 by default. *)
