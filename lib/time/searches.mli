(** The searches that {!Timing} asks, one after the other or at the same time. *)

module Limits = Dolphin_checker.Limits
module Search : module type of Dolphin_checker.Breadth_first.Make (Timed_system)

val search :
  ?working:bool -> ?enough:(Search.t -> bool) -> started:float -> Limits.t -> Successors.t -> Timed_system.goal ->
  string -> Search.t
(** [search ~enough ~started limits s goal phase] searches what {!Timed_system.create} makes, until [enough].
    @raise Timed_system.Broken *)

val steps_along :
  Timed_system.goal -> Timed_system.t -> Timed_system.arrival list -> Timed.step list
(** {!Unfold.run}.
    @raise Timed_system.Broken where that is [None] *)

(** {1:found What is found} *)

val is_later : Timed_system.date -> Timed_system.date -> bool

val best :
  (Timed_system.date -> Timed_system.date -> bool) -> Timed_system.t -> (Timed_system.date * int) option
(** [best is_better s] is the end that [is_better] than all others, with the number of its state. *)

val dates : Timed_system.t -> (Timed_system.ending * Timed_system.date) list
(** Of {!Timed_system.endings}. *)

(** {1:both Both dates} *)

(** How many processes there may be, and from how many states on they are worth it. *)
type sharing = private { workers : int; fork_from : int }

val sharing : workers:int -> fork_from:int -> Limits.t -> sharing
(** One process if memory has a bound. *)

val worth_a_fork : int

val both :
  sharing -> working:bool -> started:float -> Limits.t -> Successors.t -> Search.t * Timed.step list Early.t
(** [both sharing ~started limits s] is the search for the latest dates, and what that for the earliest finds, which
    another process does as soon as the first has [sharing.fork_from] states. If that process ends early, so do both.
    @raise Timed_system.Broken *)
