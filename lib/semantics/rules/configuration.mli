(** Configurations: <control, store, A, B, N>. *)

open Core
module Vehicle_map : Map.S with type key = vehicle

(** How a run ended. *)
type ending =
  | Completed
  | Halted of string  (** the program called [halt] with this message *)
  | Failed of Fault.t  (** a fault of the program, or an error of a task that nobody handled *)
  | Interrupted  (** from outside, by Ctrl-C for example *)

val compare_ending : ending -> ending -> int
(** An order; faults are compared with their sites. *)

type control =
  | Script of Machine.t
  | Waiting of Machine.t * Machine.request  (** the script waits; never for [Execute] *)
  | Executing of Machine.t * Residual.t  (** the script waits for the task *)
  | Ended of ending

type t = {
  control : control;
  store : Store.t;
  allocation : platform_task Vehicle_map.t;  (** A: the task that each vehicle runs; the others of B run none *)
  bound : vehicle list;  (** B, in pick order *)
  tuples : Tuples.t;  (** N *)
}

val site : t -> Core.site
(** [site c] is the place in the program where its script stands; {!Fault.unknown_site} after the end. *)

val initial : program -> t
(** [initial p] is where runs of [p] begin. *)

val compare : t -> t -> int
(** A total order, of which {!equal} is the equality. Of one program, those are equal that have the same control, store,
    A, B and N. *)

val equal : t -> t -> bool

val hash : t -> int
(** Equal configurations have equal hashes. *)

val pp : program -> Format.formatter -> t -> unit
(** The configuration in a canonical text: equal configurations print alike. *)

val invariant : t -> (unit, string) result
(** [invariant c] checks that A's vehicles are in B, that A holds exactly the tasks that run in the control, that no
    vehicle runs two, and that A and B are empty after the end. Every transition keeps it. *)
