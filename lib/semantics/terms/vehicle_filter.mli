(** What a [pick] or a [recruit] asks of a vehicle. {!Settings} reads one, and says who is accepted. *)

type t = {
  id : string option;
  kind : string option;
  payload : string list;
  region : Dolphin_geo.Area.t option;
}

val compare : t -> t -> int
