(** Tracking of vehicles that fly the ways of plans exactly, by reports that err and come seldom. *)
