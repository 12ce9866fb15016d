(** Configurations: <control, store, A, B, N>.

    {[
      open Dolphin_semantics

      let program =
        let text = "v = pick { count 1 }\nexecute v: task('survey1')" in
        let ast = Result.get_ok (Dolphin_syntax.Parse.program ~file:"a.dol" text) in
        fst (Result.get_ok (Elaborate.program ~source_name:"a.dol" ast))

      let start = Configuration.initial program

      let () =
        assert (Configuration.invariant start = Ok ());
        assert (Configuration.recruits start = [] && Configuration.waits start = []);
        match start.control with Script _ -> () | Waiting _ | Executing _ | Ended _ -> assert false
    ]} *)

open Core

(** How a run ended. *)
type ending =
  | Completed
  | Halted of string  (** the program called [halt] with this message *)
  | Failed of Fault.t  (** a fault of the program, or an unhandled error of a task *)
  | Interrupted  (** from outside, by Ctrl-C for example *)

val compare_ending : ending -> ending -> int
(** A total order; faults are compared with their sites. *)

(** The control part: the place of the script, and the task that it executes. *)
type control =
  | Script of Machine.t
  | Waiting of Machine.t * Code.request  (** the script waits; never for [Execute] *)
  | Executing of Machine.t * Residual.t  (** the script waits for the task *)
  | Ended of ending

type t = { control : control; shared : Shared.t }

val recruits : t -> Core.vehicle list
(** [recruits c] is the vehicles that the task that [c] executes has recruited and has still. *)

val initial : program -> t
(** [initial p] is the configuration where runs of [p] begin. *)

val site : t -> site
(** [site c] is the place in the program where its script stands; {!Fault.unknown_site} after the end. *)

val has_ended : t -> bool
(** Whether its control is {!Ended}. *)

val waits : t -> (Residual.timer * Residual.wait) list
(** [waits c] is the timers that run in [c] and the questions that stand: those of its residual, or the script's. *)

val compare : t -> t -> int
(** A total order, of which {!equal} is the equality. Configurations of one program are equal if they have the same
    control, store, A, B and N. *)

val equal : t -> t -> bool
(** [equal c d] is [compare c d = 0]. *)

val hash : t -> int
(** Equal configurations have equal hashes. *)

val pp : program -> Format.formatter -> t -> unit
(** The configuration in a canonical text: equal configurations print alike. *)

val invariant : t -> (unit, string) result
(** [invariant c] checks that A's vehicles are in B, that A holds exactly the tasks that run in the control, that no
    vehicle runs two, and that A and B are empty after the end. Every transition keeps it. *)
