(** Plans as the platform protocol has them: [conformance/schema/plan.schema.json]. *)

open Dolphin_semantics

val codec : Core.platform_task Dolphin_json.Codec.t
(** Plans. The site of those that are read is 0; of languages it knows [imcPlan] and [mission], the latter with names
    for all arguments. *)

val to_json : Core.platform_task -> Yojson.Safe.t
(** [to_json task] is the plan that [task] runs: by its name, or described. *)

val of_json : Yojson.Safe.t -> (Core.platform_task, string) result
(** [of_json json] is the task that runs the plan [json]. The error is its fault, or that it is in another language. *)

val language : Core.platform_task -> string
(** The kind of plan, as greetings list it: ["name"], ["imcPlan"], ["mission"]. *)
