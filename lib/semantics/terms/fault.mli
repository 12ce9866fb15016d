(** A failure while a program ran: in its own code, or on a vehicle. *)

type cause =
  | Code  (** of the program, or of a vehicle: an error, which [watch] may handle *)
  | Assertion  (** an assertion that fails ends the program, whatever is around it *)
  | Task of { vehicle : Core.vehicle; task : string }  (** a platform task that failed, by its name: an error *)
  | Unknown  (** code needed a value that a vehicle has not reported: a guard does not hold; other code has an error *)

type t = {
  message : string;  (** one sentence without a full stop: the fault, and where it helps, the remedy *)
  site : Core.site;  (** the place in the program that failed; {!unknown_site} without one *)
  cause : cause;
}

val unknown_site : Core.site
(** The site of code without a place in the program. *)

val make : Core.site -> string -> t
(** [make site message] is an error of the mission. *)

val assertion : Core.site -> string -> t
(** [assertion site message] is an assertion that does not hold: no handler sees it. *)

val of_task : Core.site -> vehicle:Core.vehicle -> task:string -> string -> t
(** [of_task site ~vehicle ~task message] is an error of that platform task on that vehicle. *)

val unknown : Core.site -> Core.unknown -> t
(** [unknown site u] is that code at [site] needed [u]. *)

val is_unknown : t -> bool
(** Whether it was made by {!unknown}. *)

val is_assertion : t -> bool
(** Whether it was made by {!assertion}. *)

val location : Core.program -> t -> Dolphin_syntax.Location.t option
(** [location p f] is the place of [f] in [p]'s text. If it is in the prelude, and one call of [p] leads there, the call
    is the place. *)

val hint : Core.program -> t -> string option
(** [hint p f] names the function of the prelude that has the place of [f], if one has; and the calls of [p] that lead
    there, if these are several. *)

