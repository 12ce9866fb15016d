(** Plans of a program, asked of adapters before anything moves ([docs/platform.md]). *)

(** A plan, and what adapters find wrong with it. *)
type verdict = {
  found : Inline_plans.found;
  answers : (string * string list) list;  (** by the name of the platform, the problems that it finds in the plan *)
}

val is_fine : verdict -> bool
(** Some platform finds nothing wrong. *)

val ask : Interruption.t -> string list -> Inline_plans.found list -> (verdict list, Error.t) result
(** [ask interruption commands plans] starts the adapters [commands], asks each about each of [plans], and ends them.
    The error names the adapter that cannot be spoken to, or does not answer; or it is {!Error.Interrupted}. *)

val lines : verdict -> string list
(** The lines to print of it: ["survey: mavlink runs it"], ["survey: mavlink: maneuver 2.YoYo: an aircraft does not
    dive"].
*)

val to_json : Inline_plans.found -> Yojson.Safe.t
(** The plan as adapters get it. *)
