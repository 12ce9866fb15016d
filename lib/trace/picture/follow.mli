(** The interactive part of a picture's page: a legend of the vehicles, sorted by name, that highlights the one under
    the pointer in all charts; and a slider that shows their places and tasks at any time. *)

val style : string
(** Rules for a style sheet. *)

val parts : Summary.t -> moments:(float * (float * float)) list list -> Svg.t list
(** [parts run ~moments] are elements of a page with the picture of [run]; [moments] is the places of each vehicle on
    its map, with times ({!Tracks.moments}). Nothing outside of the page is needed. *)
