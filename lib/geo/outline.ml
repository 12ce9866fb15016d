(* Things on a map as they are drawn; whether they make areas is not checked. A types-only module: it has no interface
   of its own. *)

type t =
  | Spot of Position.t
  | Way of Position.t list
  | Rings of Position.t list list  (* rims and holes: a place is inside if it is within an odd number of them *)
  | Round of { centre : Position.t; radius : float  (* m *) }
