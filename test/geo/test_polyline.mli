(* The tests of {!Dolphin_geo.Polyline} alone. *)
