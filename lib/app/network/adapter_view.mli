(** The vehicles of adapters ([docs/platform.md]), listed on standard output. *)

val run :
  string list -> Interruption.t -> as_json:bool -> once:bool -> seconds:float option -> (unit, Error.t) result
(** [run commands interruption ~as_json ~once ~seconds] starts the adapters [commands], which are told that nothing will
    be ordered, and lists their vehicles as {!Listing.show} does. *)
