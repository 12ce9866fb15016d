(** Processes that search together: a leader and workers that it forks, with memory that they share. This module does
    not depend on the object of their search.

    All go through the levels of a search in step. A level is a part of each worker's segment of states; each worker
    takes blocks of its own part, and then of others' parts. At {!meet} each process waits for all others.

    {b Numberings.} While there are workers, numberings are closed ({!Numbering}). A process that needs a new number
    calls {!learn}: one process at a time computes the number, and then sends the others the key for it. Before it
    learns, and between levels, each process has repeated all earlier learning steps of the others, in the same order.
    So a number is the same in all of them, if what is learnt gives the same numbers wherever the same was learnt
    before.

    {b Giving up.} Whatever else comes up in the midst of a level is left to the leader: the workers end, and the leader
    goes on alone from there. *)

type t

exception Over
(** In a worker, and in the leader while it waits: the level need not be ended. *)

val create : (unit -> Shared_states.t) -> Numbering.t -> workers:int -> look:(unit -> unit) -> t
(** [create s n ~workers ~look] is a leader, one of [workers], without the others. [s ()] is the system that they
    search. [look ()] is called now and then while the leader waits; its exceptions pass through.
    @raise Out_of_memory if the system does not grant the addresses *)

val close : t -> unit
(** Gives back the memory of [t], in this process. *)

(** {1 Levels} *)

val begin_levels : t -> depth:int -> from:int -> unit
(** [begin_levels t ~depth ~from] makes the states from place [from] on of the leader's segment a level, at [depth]. *)

val depth : t -> int
(** The depth of the present level. *)

type block = { segment : int; mutable first : int; upto : int }
(** Places of a worker's segment from [first] on, before [upto]. *)

val take : t -> block option
(** [take t] is the next block for this process; [None] if nothing is left of the level, or it need not be ended. *)

val leave : t -> block -> unit
(** [leave t block] leaves [block] to the leader, and all others end as soon as they have expanded what they took. *)

val give_up : t -> unit
(** [give_up t] is that the level need not be ended: all end as soon as they have expanded what they took. *)

val left : t -> block list
(** The unexpanded rest, after {!lead}. *)

(** {1 Meeting} *)

type reason =
  | Done  (** no block is left to take *)
  | Full  (** the table has to grow *)

val meet : t -> deepen:(unit -> unit) -> reason -> bool
(** [meet t ~deepen reason] waits for all others. It is [false] if there is nothing to do any more. The leader calls
    [deepen ()] before a level begins; its exceptions pass through. *)

(** {1 Learning} *)

val learn : t -> words:int -> (int array -> unit) -> int array -> unit
(** [learn t ~words f key] applies [f] to the keys that others have learnt, and then to [key], whose first [words] words
    it sends to the others. Numberings are open meanwhile. Exceptions of [f key] pass through, and no process learns any
    more.
    @raise Over if learning has ended *)

val catch_up : t -> words:int -> (int array -> unit) -> unit
(** [catch_up t ~words f] applies [f] to the keys that others have learnt. *)

(** {1 Processes} *)

val lead : t -> work:(unit -> unit) -> report:(unit -> string) -> string list * (exn * Printexc.raw_backtrace) option
(** [lead t ~work ~report] forks workers, and is the [report] of each after its [work], which this process does as well;
    and the exception of [work] here, if it raises one. In that case the others end what they are at, or are killed
    within a second and report nothing. When it returns all of them have ended.
    @raise Limits.Stop if a worker ends otherwise than after its report *)

val is_worker : t -> bool
(** Whether this process is a worker, and not the leader. *)

val look : t -> unit
(** In a worker: ends the process if the leader has ended.
    @raise Over
    In the leader:
    @raise Limits.Stop if a worker has ended *)

val tell : t -> expanded:int -> transitions:int -> heap:int -> unit
(** [tell t ~expanded ~transitions ~heap] records the work of a worker since it was forked, and the bytes of its
    heap. *)

val told : t -> int * int
(** The sums of the last records of running workers, of expanded states and of transitions. *)

val heaps_of_others : t -> int
(** The same sum of bytes. *)
