(** Ends of tasks that nothing waits for but the end of the whole executed task. No other step depends on their
    dates: docs/time.md shows why they need not be followed one by one. *)

open Dolphin_semantics

type t

val names_are_free : Clocked.options -> bool
(** [names_are_free o] is whether no step depends on which vehicle is held or lost, or comes late, and there are no
    posts from outside, no interruptions, and no changes of links during tasks. *)

val create : Clocked.options -> t
(** [create o] finds the inert ends in runs of [o]. Mutable: results are memoised. *)

type item = { awaited : Clocked.item; least : int; most : int }
(** Its bounds, from its beginning. *)

val of_state : t -> Clocked.state -> item list
(** [of_state i s] is the awaited events of [s] whose end only shortens [s], in ascending order. *)

val is_rest : Clocked.state -> item list -> bool
(** [is_rest s items] is whether nothing is left of the executed task but [items], one at least. *)

val without : Clocked.item list -> Configuration.t -> Configuration.t option
(** [without items c] is [c] once [items], which are inert, have ended; [None] if nothing would be left of the task. *)
