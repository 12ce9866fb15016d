(** The conditions of a [pick] or a [recruit] on a vehicle. {!Settings} reads one, and defines the accepted vehicles. *)

type t = {
  id : string option;
  kind : string option;
  payload : string list;
  region : Dolphin_geo.Area.t option;
}

val compare : t -> t -> int
(** A total order. *)
