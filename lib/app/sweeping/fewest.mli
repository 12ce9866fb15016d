(** The least fleet that will do: [dolphin time --fewest]. *)

module Timed_analysis = Dolphin_time.Timed_analysis

(** Reasons against a fleet. *)
type trouble =
  | Property of Dolphin_explore.Property.t * Dolphin_explore.Search.outcome  (** is violated *)
  | Time of Timed_analysis.shortfall * Timed_analysis.outcome
  | Bound of Dolphin_checker.Limits.bound  (** met by the exploration: unknown *)

type vehicles = Dolphin_semantics.Core.vehicle list
(** A part of a fleet, in the order of the fleet. *)

type t =
  | Least of {
      vehicles : vehicles;
      outcome : Timed_analysis.outcome;  (** with these *)
      without : (Dolphin_semantics.Core.vehicle * trouble) list;  (** each of them *)
      unsure : vehicles list;  (** smaller fleets with an unknown answer *)
    }
  | None_does of { all : trouble; unsure : vehicles list }
  (** no subset of the fleet is known to suffice, nor all of it: the reasons against [all] of it *)
  | Interrupted of int  (** no fleet of fewer vehicles than this will do, of those that are known *)

val find :
  interrupted:(unit -> bool) -> progress:(Dolphin_checker.Limits.progress -> unit) -> Time_analysis.settings ->
  Program_file.t -> Fleet_file.t -> t * int
(** [find ~interrupted ~progress s program fleet] is the first of the smallest parts of [fleet], by the order of its
    vehicles, with which no property of {!Exploration} is violated and nothing is {!Timed_analysis.shortfall}; and how
    many parts were looked at: all that are smaller. *)

val verdict : t -> Sweep.verdict
(** [Holds] for [Least] without [unsure] fleets; [Violated] if no part of the fleet does, and each is known not to; else
    [Inconclusive]. *)

val print : ?deadline:int -> Program_file.t -> Fleet_file.t -> t * int -> unit
(** The fleet; the fault without each of its vehicles; a run with the fault without the first of them, and one that
    ends last with all. *)

val to_json : ?deadline:int -> Program_file.t -> t * int -> Yojson.Safe.t
(** The same as {!print}, for programs. *)
