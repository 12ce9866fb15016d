(** The plans that a program gives to vehicles, inline ones and those that vehicles know by name. *)

open Dolphin_plans
open Dolphin_semantics

(** A plan that a run gives to vehicles. *)
type found = {
  name : string;
  plan : Inline_plan.t option;  (** [None]: vehicles know it by name *)
  from : Dolphin_geo.Position.t;  (** the place of the first vehicle with the plan at that time *)
  speed : float;  (** that vehicle's, in metres per second, if the plan has none *)
  vehicles : Core.vehicle list;  (** those that get it, the first one first *)
}

val of_run :
  Program_file.t -> Fleet_file.t -> seed:int -> answers:string list -> found list * Dolphin_runtime.Driver.outcome
(** [of_run program fleet ~seed ~answers] is the plans given to vehicles in a run on the simulated [fleet], each once
    by its name and its description, the first one first; and the ending of that run. It takes no longer than it
    takes to compute, and is interrupted after 200,000 transitions. *)

val to_json : Dolphin_imc.Definition.t option -> Inline_plan.t -> Yojson.Safe.t
(** [to_json definition plan] is the PlanSpecification that IMC vehicles get, by the user's definition of IMC if there
    is one; of a mission, the plan that adapters get. *)

val broken : Fences.t -> found -> Fences.breach option
(** The fence that the plan breaks, from its vehicle's place then. *)

val summary : Fences.t -> found list -> Dolphin_runtime.Driver.outcome -> Yojson.Safe.t
(** [summary fences plans outcome] is the data of {!of_run} for people and maps: [plans], each with [plan], its name,
    [vehicles], [way], [null] if vehicles know it by name, and [breaks], [null] or [why] it breaks a fence and [at]
    which place, [null] if that is too deep or too high; and [unfinished], why the run did not complete, or [null]. A
    way goes [from] a place through [maneuvers], each with [maneuver], its name, [points], [speed] and [stays], the
    seconds at its last point. It is [metres] long and takes [seconds]. A plan without an end has [null]; places are
    pairs of latitude and longitude. *)
