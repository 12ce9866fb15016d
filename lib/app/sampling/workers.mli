(** Work by numbers, shared out among processes. *)

type 'a t

val start : jobs:int -> first:int -> ?last:int -> (int -> 'a) -> 'a t
(** [start ~jobs ~first ~last f] computes [f first], [f (first + 1)] and so on, up to [f last], or without end, in
    [jobs] processes. What [f] gives has no functions in it. The processes end when they are done, when {!stop} is
    called, or when this process dies. They do not heed Ctrl-C. *)

exception Died of int
(** A process died at this number: [f] raised an exception, which it told on standard error, or it was killed. *)

val next : 'a t -> timeout:float -> (int * 'a) list
(** [next w ~timeout] is what is new, waiting for something for so many seconds at most.
    @raise Died *)

val is_done : 'a t -> bool
(** Whether all is computed, and was given. *)

val under_way : 'a t -> int list
(** The numbers whose results are awaited next, one of each process that still computes. *)

val stop : 'a t -> unit
(** Kills the processes, and waits until they are gone. *)
