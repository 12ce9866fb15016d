(** Work that is independent, in several processes. *)

val jobs : int
(** How many: the environment's [JOBS], by default 2. *)

val map : ('a -> 'b) -> 'a list -> 'b list
(** [map f xs] is [List.map f xs], computed in {!jobs} processes: the first one takes the first element, and so on by
    turns. The output of [f] is printed. Results hold no functions. It fails if [f] does. *)
