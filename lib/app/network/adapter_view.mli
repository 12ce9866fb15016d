(** The vehicles of adapters ([docs/platform.md]), listed on standard output. *)

val run :
  string list -> Interruption.t -> as_json:bool -> once:bool -> seconds:float option -> (unit, Error.t) result
(** [run commands interruption ~as_json ~once ~seconds] starts the adapters [commands], announces that no orders will
    follow, and lists their vehicles as {!Listing.show} does. *)
