(** Maps of other programs below the ways of a picture: a coast, an area of work, anything. *)

open Dolphin_geo

type t = {
  name : string;  (** as legends have it *)
  outlines : (string * Outline.t) list;  (** each with its name, perhaps [""] *)
}

val places : t -> Position.t list list
(** The places of each outline. *)

val draw :
  project:(Position.t -> float * float) -> thin:((float * float) list -> (float * float) list) ->
  left:float -> right:float -> top:float -> bottom:float -> int -> t -> Svg.t list
(** [draw ~project ~thin ~left ~right ~top ~bottom i layer] is the part of [layer], the [i]th of its picture, near
    these bounds; of ways [thin] leaves out details too fine to be seen. *)

val key : int -> string
(** The class of the [i]th layer's line in a legend. *)
