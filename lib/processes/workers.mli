(** Work by numbers, shared out among processes.

    {[
      open Dolphin_processes

      let squares = Workers.start ~jobs:2 ~first:1 ~last:9 (fun n -> n * n)

      let rec all found =
        if Workers.is_done squares then List.sort compare found
        else all (Workers.next squares ~timeout:1. @ found)

      let () = assert (all [] = List.init 9 (fun i -> (i + 1, (i + 1) * (i + 1))))
    ]} *)

type 'a t

val start : jobs:int -> first:int -> ?last:int -> (int -> 'a) -> 'a t
(** [start ~jobs ~first ~last f] computes [f first], [f (first + 1)] and so on, up to [f last], or without end, in
    [jobs] processes. The result of [f] contains no functions, and is a copy: nothing in it is physically equal to
    values of this process. The processes end when they are done, when {!stop} is called, or when this process dies.
    They do not heed Ctrl-C.
    @raise Unix.Unix_error if not all of them can be made; then none exists *)

exception Died of { number : int; how : string }
(** The process that computed this number ended early: [f] raised an exception, which it printed on standard error,
    or it was killed. [how] is ["killed"], or ["with status 1"]. *)

val how : Unix.process_status -> string
(** The end of a process, in the form of {!Died}. *)

val next : 'a t -> timeout:float -> (int * 'a) list
(** [next w ~timeout] is the new results, after waiting for at most [timeout] seconds.
    @raise Died *)

val is_done : 'a t -> bool
(** Whether all is computed, and was given. *)

val under_way : 'a t -> int list
(** The numbers whose results are awaited next, one of each process that still computes. *)

val stop : 'a t -> unit
(** Kills the processes, and waits until they are gone. *)
