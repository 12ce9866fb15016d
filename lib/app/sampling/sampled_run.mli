(** One simulated run, and its counts. *)

open Dolphin_semantics

(** How a run ended. Two runs ended alike if these are equal. *)
type ending =
  | Completed
  | Halted of string  (** its messages *)
  | Failed of Fault.t
  | Stuck of Core.site option  (** in rounds that begin there, or for nothing can happen any more *)

(** A platform task by its plan, its vehicle and its place in the program. *)
type task = { name : string; vehicle : Core.vehicle; site : Core.site }

(** How often a task did what. *)
type counts = { began : int; ended : int; failed : int; stopped : int }

type t = {
  seconds : float;  (** when it was over *)
  ending : ending;
  tasks : (task * counts) list;  (** those that began, in the order in which they began first *)
  handlers : (Core.site * int) list;  (** of errors, each with how often it ran *)
}

val run : seed:int -> answers:string list -> Program_file.t -> Fleet_file.t -> (t, Error.t) result
(** [run ~seed ~answers program fleet] is the run that [dolphin exec --seed] makes, at once. *)
