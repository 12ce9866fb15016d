(** Programs in their worlds, for TLC and the explorer to agree on. *)

type t = {
  name : string;
  source : string;
  program : Dolphin_semantics.Core.program;
  world : Dolphin_semantics.World.t;
  environment : Dolphin_explore.Environment.options;
  plans : string list;  (** that the environment may treat in a way of their own *)
  prompts : string list;  (** likewise *)
}

val random : seed:int -> int -> t list
(** [random ~seed n] is [n] programs of [Test_support.Generate]: a third without failures, a third with any number, a third
    with at most one in a run; a quarter of them repeat for ever what they do. The same for the same seed. *)

val examples : string -> t list
(** [examples directory] is the programs there, each with its fleet, first as the fleet says and then with failures of all
    plans. A program that cannot be compiled is an error of ours, and raises [Failure]. *)

val traps : t list
(** Small programs for what random ones seldom meet. *)
