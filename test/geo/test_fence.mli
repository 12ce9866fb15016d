(* The tests of {!Dolphin_geo.Fence} alone. *)
