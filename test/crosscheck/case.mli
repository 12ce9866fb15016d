(** Programs in their worlds, for TLC and the explorer to agree on. *)

type t = {
  name : string;
  source : string;
  program : Dolphin_semantics.Core.program;
  world : Dolphin_semantics.World.t;
  environment : Dolphin_environment.Environment.options;
  plans : string list;  (** that the environment may treat in a way of their own *)
  prompts : string list;  (** the same in reverse *)
  calls : string list;  (** in the same way *)
}

val random : seed:int -> int -> t list
(** [random ~seed n] is [n] programs of [Test_support.Generate]: without faults, with failures, with losses, with
    vehicles that are late, with and without a bound, with interruptions, by turns; a quarter of them repeat their
    task without end, a third call the supplier of [Test_support.Calls]. The same for the same seed. *)

val sensing : seed:int -> int -> t list
(** Programs that look at sensors, in a world where these have listed or open values. *)

val examples : string -> t list
(** [examples directory] is the programs there, each with its fleet, first by the fleet and then with failures of all
    plans. A program that cannot be compiled is an error of ours, and raises [Failure]. *)

val faulty_examples : string -> t list
(** The same with losses, with a vehicle that is late, with at most one fault of each kind, with interruptions, and
    with calls of a supplier that fail. *)

val with_fleets :
  (string * Dolphin_environment.Faults.t) list -> string -> (t * Dolphin_scenario.Scenario.t) list
(** [with_fleets kinds directory] is the programs there, each with its fleet, with each kind of faults; the name has
    the kind. *)

(** {1:texts Programs by their texts} *)

val of_text : string -> string -> Dolphin_semantics.World.t -> Dolphin_environment.Environment.options -> t
(** [of_text name source world environment] is the program [source] there. One that cannot be compiled is an error of
    ours, and raises [Failure]. *)

val answering : Dolphin_environment.Environment.options
(** All goes as planned, with answers to ["how many?"], and with the replies of [Test_support.Calls]. *)

val with_losses : Dolphin_environment.Faults.limit -> Dolphin_environment.Environment.options
val with_latecomers : Dolphin_environment.Faults.limit -> Dolphin_environment.Environment.options

val all_once : Dolphin_environment.Environment.options
(** {!answering} with at most one failure, one loss and one vehicle that is late. *)

val interrupted : Dolphin_environment.Environment.options -> Dolphin_environment.Environment.options
(** [interrupted e] is [e] where the program may be interrupted. *)

val in_fleet : string -> string -> Dolphin_scenario.Scenario.t -> Dolphin_environment.Faults.t -> t
(** [in_fleet name source scenario faults] is the program [source] with that fleet. *)
