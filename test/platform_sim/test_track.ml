open Dolphin_platform_sim
open Dolphin_geo
open Common

let home = Place.apdl
let near north east = Wgs84.displace home ~north ~east
let metres = Alcotest.float 0.01

let way_of_legs () =
  let leg waypoints speed dwell : Track.leg = { waypoints; vertical = Level; speed; dwell } in
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
  let way = Track.through home [ { waypoints = [ near 100. 0. ]; vertical = Level; speed = 1.; dwell = infinity } ] in
  Alcotest.(check (float 0.)) "without end" infinity (Track.duration way);
  Alcotest.check metres "still from its arrival" 100. (Track.still_from way);
  Alcotest.check metres "there" 100. (Wgs84.distance home (Track.position way 1e9));
  Alcotest.(check (float 0.)) "nowhere" 0. (Track.duration (Track.there_and_back home home ~speed:1. ~duration:0.));
  Alcotest.(check bool) "nowhere to be" true
    (Position.equal home (Track.position (Track.circuit home ~bearing:0. ~speed:1. ~duration:0.) 0.))

(* {1 Heights} *)

let high height (p : Position.t) = { p with height }

let reaching ?swing ?(rate = 0.5) ?(stays_at = 0.) ?(dwell = 0.) waypoints : Track.leg =
  { waypoints; vertical = Reaching { rate; stays_at; swing }; speed = 1.; dwell }

let heights what way expected =
  let check (time, height) =
    Alcotest.check metres (Printf.sprintf "%s after %g s" what time) height (Track.position way time).height in
  List.iter check expected

let dives () =
  let down = reaching [ high (-10.) (near 0. 100.) ] and on = reaching [ high (-4.) (near 0. 200.) ] in
  let way = Track.through home [ down; on ] in
  heights "at its rate" way [ (0., 0.); (10., -5.); (20., -10.); (100., -10.); (106., -7.); (112., -4.); (900., -4.) ];
  Alcotest.check metres "no longer for it" 200. (Track.duration way);
  heights "as far as it gets" (Track.through home [ reaching [ high (-100.) (near 0. 100.) ] ]) [ (100., -50.); (900., -50.) ];
  let level : Track.leg = { (reaching [ near 0. 200. ]) with vertical = Level } in
  heights "and stays" (Track.through home [ down; level ]) [ (150., -10.); (900., -10.) ];
  let surface = Track.through home [ down; reaching ~stays_at:0. ~dwell:infinity [] ] in
  heights "up for its stay" surface [ (100., -10.); (110., -5.); (120., 0.); (1e9, 0.) ];
  Alcotest.check metres "at the surface it is still" 120. (Track.still_from surface)

let swings () =
  let swing : Track.swing = { low = -20.; high = -2.; slope = 0.25 } in
  let way = Track.through home [ reaching ~swing [ high (-11.) (near 0. 300.) ] ] in
  heights "down, up, and down" way [ (2., -1.); (4., -2.); (40., -11.); (76., -20.); (112., -11.); (148., -2.); (184., -11.) ];
  let below = Track.through (high (-24.) home) [ reaching ~swing [ high (-11.) (near 0. 300.) ] ] in
  heights "from below up first" below [ (4., -22.); (8., -20.); (80., -2.); (116., -11.) ];
  let stay dwell = Track.through home [ reaching ~swing ~stays_at:(-11.) ~dwell [ high (-11.) (near 0. 100.) ] ] in
  heights "only where it stays" (stay 200.) [ (100., -11.); (136., -20.); (172., -11.); (300., -15.); (900., -15.) ];
  heights "without end, not at all" (stay infinity) [ (100., -11.); (1e6, -11.) ];
  Alcotest.check metres "so there is news for some time only" 100. (Track.still_from (stay infinity))

let legs_up_and_down =
  let open QCheck2.Gen in
  let height = float_range (-40.) 5. in
  let swing =
    map3 (fun low span slope : Track.swing -> { low; high = low +. span; slope }) height (float_range 0. 10.)
      (float_range 0. 0.5) in
  let leg =
    map3
      (fun swing stays_at (east, height, dwell) ->
         reaching ?swing ~stays_at ~dwell [ high height (near 0. east) ])
      (option swing) height
      (triple (float_range (-200.) 200.) height (oneof [ pure 0.; float_range 0. 200. ])) in
  list_size (int_range 0 6) leg

let steadily =
  let leg ({ waypoints; vertical; dwell; _ } : Track.leg) =
    let swing = match vertical with Reaching { swing = Some s; _ } -> [ s.low; s.high; s.slope ] | _ -> [] in
    String.concat " "
      (List.map string_of_float (swing @ List.map (fun (p : Position.t) -> p.height) waypoints @ [ dwell ])) in
  law "nobody jumps up or down" legs_up_and_down ~print:(QCheck2.Print.list leg) (fun legs ->
      let way = Track.through home legs in
      let duration = Track.duration way in
      let height i = (Track.position way (duration *. float_of_int i /. 500.)).height in
      List.for_all
        (fun i -> Float.abs (height (i + 1) -. height i) <= (0.5 *. duration /. 500.) +. 1e-6)
        (List.init 502 Fun.id))

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
  Alcotest.run "track"
    [ ("ways", [ case "legs" way_of_legs; case "stays" stays ]);
      ("heights", [ case "dives" dives; case "swings" swings; steadily ]); ("laws", [ circuits; excursions ]) ]
