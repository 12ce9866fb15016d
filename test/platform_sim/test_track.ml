open Dolphin_platform_sim
open Dolphin_geo
open Common

let home = Place.apdl
let near north east = Wgs84.displace home ~north ~east
let metres = Alcotest.float 0.01

let way_of_legs () =
  let leg waypoints speed dwell : Track.leg = { waypoints; speed; dwell } in
  let legs = [ leg [ near 0. 100.; near 0. 300. ] 2. 50.; leg [] 1. 10.; leg [ near 0. 290. ] 1. 0. ] in
  let way = Track.through home legs in
  Alcotest.check metres "lasts" (150. +. 50. +. 10. +. 10.) (Track.duration way);
  let check (time, east) =
    Alcotest.check metres (string_of_float time) east (Wgs84.distance home (Track.position way time)) in
  List.iter check
    [ (0., 0.); (25., 50.); (50., 100.); (100., 200.); (150., 300.); (180., 300.); (210., 300.); (215., 295.);
      (220., 290.); (500., 290.) ];
  Alcotest.(check (float 0.)) "moves to the end" (Track.duration way) (Track.still_from way)

let stays () =
  Alcotest.(check (float 0.)) "at once" 0. (Track.duration (Track.stay home));
  let way = Track.through home [ { waypoints = [ near 100. 0. ]; speed = 1.; dwell = infinity } ] in
  Alcotest.(check (float 0.)) "without end" infinity (Track.duration way);
  Alcotest.check metres "still from its arrival" 100. (Track.still_from way);
  Alcotest.check metres "there" 100. (Wgs84.distance home (Track.position way 1e9));
  Alcotest.(check (float 0.)) "nowhere" 0. (Track.duration (Track.there_and_back home home ~speed:1. ~duration:0.));
  Alcotest.(check bool) "nowhere to be" true
    (Position.equal home (Track.position (Track.circuit home ~bearing:0. ~speed:1. ~duration:0.) 0.))

let amounts = QCheck2.Gen.(triple (float_range 0.1 30.) (float_range 0. 4000.) (float_range 0. 360.))
let print = QCheck2.Print.(triple float float float)

(* No faster than the vehicle can go. *)
let within_speed way speed =
  let duration = Track.duration way in
  let position i = Track.position way (duration *. float_of_int i /. 100.) in
  let step i = Wgs84.distance (position i) (position (i + 1)) <= (speed *. duration /. 100. *. 1.001) +. 0.001 in
  List.for_all step (List.init 100 Fun.id)

let returns way home = Position.equal home (Track.position way (Track.duration way))

let circuits =
  law "a circuit lasts, returns, keeps to its speed" amounts ~print (fun (speed, duration, bearing) ->
      let way = Track.circuit home ~bearing ~speed ~duration in
      (Track.duration way = duration && returns way home && within_speed way speed)
      && Wgs84.distance home (Track.position way (duration /. 3.)) <= 400.)

let excursions =
  law "there and back lasts, returns, keeps to its speed" amounts ~print (fun (speed, duration, bearing) ->
      let way = Track.there_and_back home (Wgs84.move home ~bearing 1500.) ~speed ~duration in
      Track.duration way = duration && returns way home && within_speed way speed)

let () =
  Alcotest.run "track" [ ("ways", [ case "legs" way_of_legs; case "stays" stays ]); ("laws", [ circuits; excursions ]) ]
