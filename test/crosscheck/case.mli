(** Programs in their worlds, for TLC and the explorer to agree on. *)

type t = {
  name : string;
  source : string;
  program : Dolphin_semantics.Core.program;
  world : Dolphin_semantics.World.t;
  environment : Dolphin_environment.Environment.options;
  plans : string list;  (** that the environment may treat in a way of their own *)
  prompts : string list;  (** likewise *)
  calls : string list;  (** likewise *)
}

val random : seed:int -> int -> t list
(** [random ~seed n] is [n] programs of [Test_support.Generate]: without faults, with failures, with losses, with
    vehicles that are late, with and without a bound, with interruptions, by turns; a quarter of them repeat for ever what
    they do, a third call the supplier of [Test_support.Calls]. The same for the same seed. *)

val sensing : seed:int -> int -> t list
(** Likewise, programs that look at sensors, in a world where these may show this or that. *)

val examples : string -> t list
(** [examples directory] is the programs there, each with its fleet, first as the fleet says and then with failures of all
    plans. A program that cannot be compiled is an error of ours, and raises [Failure]. *)

val faulty_examples : string -> t list
(** Likewise with losses, with a vehicle that is late, with at most one fault of each kind, with interruptions, and with
    calls of a supplier that fail. *)

val traps : t list
(** Small programs for what random ones seldom meet, some of which may be interrupted. *)

val sensor_traps : t list
(** Likewise, in a world that leaves open what sensors show. *)

val faulty_traps : t list
(** Likewise for losses and vehicles that are late. *)
