(** Plans of QGroundControl. *)

val read : string -> Drawn.t list
(** ["home"]; the way of the mission, ["mission"], of the commands that are flown to a place; areas and ways of its
    surveys, ["survey 1"], ["corridor 1"], ["structure 1"]; of the fence, the areas to stay in, ["inside 1"], and those
    to stay out of, ["outside 1"]; ["rally 1"]. Landing patterns and items that are not known are left out. Raises
    {!Drawn.Wrong}. *)
