(** The rest of a plan that was cut: what remains of plans of maneuvers and of missions, and the laws of the cut. *)
