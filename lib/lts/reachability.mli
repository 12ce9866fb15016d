(** The reachable states, and shortest runs to them. *)

(** A transition of a run: its label, and the state that it leads to. *)
type step = { label : string; target : int }

type run = { start : int; steps : step list }
(** A run from [start]. *)

val trace : run -> string list
(** The labels of a run. *)

val finish : run -> int
(** The state where a run ends. *)

val reachable : Graph.t -> bool array
(** [(reachable g).(s)]: whether [s] can be reached from the initial state. *)

val trim : Graph.t -> Graph.t
(** [trim g] is the part of [g] that can be reached, numbered breadth first: the initial state is 0. *)

val shortest : ?from:int -> Graph.t -> (int -> bool) -> run option
(** [shortest g p] is a shortest run from the initial state, or from [from], to a state where [p] holds. *)
