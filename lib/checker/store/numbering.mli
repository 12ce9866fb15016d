(** Whether a system may give new numbers to new parts.

    A number stands for the first, second ... part met; so it means nothing to another process that has met other
    parts. Processes that search one system together close its numberings, and give numbers one at a time, in one
    order ({!Team}). Code that gives numbers for use in a state, in its stored form, or in reports of a search, calls
    {!give} first; {!Interner} does. *)

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
