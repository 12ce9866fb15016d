(** What a page adds to the picture of a run: a legend of the vehicles, sorted by name, that brings out the one under
    the pointer in all charts; and a slider that shows where they were at any time, and what they ran. *)

val style : string
(** Rules for a style sheet. *)

val parts : Summary.t -> moments:(float * (float * float)) list list -> Svg.t list
(** [parts run ~moments] are elements of a page with the picture of [run]; [moments] is where each vehicle is on
    its map, and when ({!Tracks.moments}). Nothing outside of the page is needed. *)
