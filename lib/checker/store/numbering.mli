(** Whether this process may give new numbers.

    A number stands for what was met first, second and so on; so it means nothing to another process that has met other
    things. Processes that search together close their numberings, and give numbers one at a time, in one order
    ({!Team}). Whatever gives numbers that end up in a state, in the way that it is stored, or in what is told of a
    search, calls {!give} first; {!Interner} does. *)

exception Closed
(** A number would have to be given. *)

val give : unit -> unit
(** [give ()] is called before something is numbered, while nothing of it is remembered yet.
    @raise Closed if numberings are closed *)

val closed : (unit -> 'a) -> 'a
(** [closed f] is [f ()], during which numberings are closed. *)

val opened : (unit -> 'a) -> 'a
(** [opened f] is [f ()], during which they are not. *)
