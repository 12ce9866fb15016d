(** Whether new numbers may be given to what a system meets.

    A number stands for what was met first, second and so on; so it means nothing to another process that has met other
    things. Processes that search one system together close its numberings, and give numbers one at a time, in one
    order ({!Team}). Whatever gives numbers that end up in a state, in the way that it is stored, or in what is told of
    a search, calls {!give} first; {!Interner} does. *)

type t
(** All numberings of a system. *)

exception Closed
(** A number would have to be given. *)

val create : unit -> t
(** They are open. *)

val give : t -> unit
(** [give t] is called before something is numbered, while nothing of it is remembered yet.
    @raise Closed if [t] is closed *)

val closed : t -> (unit -> 'a) -> 'a
(** [closed t f] is [f ()], during which [t] is closed. *)

val opened : t -> (unit -> 'a) -> 'a
(** [opened t f] is [f ()], during which [t] is open. *)
