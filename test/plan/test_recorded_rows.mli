(** The ways of [rows] beside those that real vehicles took: positions of LSTS's DUNE, every 5 seconds, in metres
    north and east of the maneuver's place. *)
