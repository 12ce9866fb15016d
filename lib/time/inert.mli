(** Tasks, and sequences of them, that nothing waits for but the end of the whole executed task. No other step depends
    on their dates: docs/time.md shows why they need not be followed one by one. *)

open Dolphin_semantics

type t

val names_are_free : Clocked.options -> bool
(** [names_are_free o] is whether no step depends on which vehicle is held or lost, or comes late, and there are no
    posts from outside, no interruptions, and no changes of links during tasks. *)

val create : Clocked.options -> t
(** [create o] finds the inert ends in runs of [o]. Mutable: results are memoised. *)

val handled : t -> Residual.t -> Residual.t
(** [handled i r] is [r] without the handlers to which no error comes: none comes out of tasks that certainly succeed,
    and code that cannot be faulty. *)

(** A task that certainly succeeds, or an [idle]. *)
type part = {
  event : Clocked.item;  (** ends it *)
  task : Core.platform_task option;
  least : int;  (** in milliseconds from its beginning, as all bounds here *)
  most : int;
  follow : int;  (** the steps after its end that take no time: actions, and the start of the next part *)
}

(** A sequence of such parts, the first of which runs, all on one vehicle, with actions between them that nothing
    depends on, in rounds, and under handlers: [repeat 3, (task('p') >> action { message 'p ends' } >> task('q'))]. *)
type item = {
  awaited : Clocked.item;  (** the event of its first part *)
  parts : part list;  (** at least one *)
  least : int;  (** of all parts, from the beginning of the first: the sum *)
  most : int;
}

val is_awaited : item list -> Clocked.item -> bool
(** [is_awaited items e] is whether one of [items] awaits [e], so that [e] is not followed. *)

val steps : item -> int
(** [steps i] is the number of steps from the beginning of the first part to the end of all. *)

val of_state : t -> Clocked.state -> item list
(** [of_state i s] is the parallel parts of [s] that are such sequences, in ascending order of their awaited events. *)

val awaited : Residual.t -> Clocked.item option
(** [awaited r] is the end that [r], a part of an executed task, waits for, if it begins with a task that runs, or with
    an [idle]. *)

val is_rest : Clocked.state -> item list -> bool
(** [is_rest s items] is whether nothing is left of the executed task but [items], one at least. *)

val without : Clocked.item list -> Configuration.t -> Configuration.t option
(** [without items c] is [c] without those that await [items], which are inert; [None] if nothing would be left of the
    task. *)
