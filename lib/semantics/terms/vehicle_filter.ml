(* What a [pick] or a [recruit] asks of a vehicle. A types-only module: it has no interface of its own. {!Settings}
   reads one, and says who is accepted. *)

type t = {
  id : string option;
  kind : string option;
  payload : string list;
  region : Dolphin_geo.Area.t option;
}
