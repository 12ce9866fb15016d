open Dolphin_plans
open Dolphin_semantics
open Core
open Writing
module Position = Dolphin_geo.Position
module Place = Dolphin_geo.Place
module Wgs84 = Dolphin_geo.Wgs84
module Area = Dolphin_geo.Area
module Survey = Dolphin_geo.Survey

let build ?(name = "p") settings =
  Mission_builder.build ~name plan_site (List.mapi (fun k s -> { s with setting_site = k }) settings)

let built settings =
  match build settings with Ok mission -> mission | Error fault -> Alcotest.fail fault.message

let home = Place.apdl
let corridor = Result.get_ok (Area.corridor [ home; Wgs84.displace home ~north:90. ~east:0. ] 10.)
let moved north east = Wgs84.displace home ~north ~east
let place p = Position p
let near = Alcotest.testable Position.pp (fun a b -> Wgs84.distance a b < 1e-3)

(* {1 Items} *)

let only setting =
  match (built [ setting ]).items with
  | [ item ] -> item
  | items -> Alcotest.failf "%d items where there should be one" (List.length items)

let reads what setting word arguments =
  case what (fun () ->
      let item = only setting in
      Alcotest.(check string) "word" word item.word;
      Alcotest.(check bool) "arguments" true (List.sort compare arguments = List.sort compare item.arguments))

let number name x = (name, Mission_plan.Number x)

let items =
  [ reads "by order" (set "takeOffWithYaw" [ i 30; i 90 ]) "takeOffWithYaw" [ number "altitude" 30.; number "yaw" 90. ];
    reads "by name" (set "loiterTurns" [] ~named:[ ("turns", i 2); ("radius", i (-40)) ]) "loiterTurns"
      [ number "turns" 2.; number "radius" (-40.) ];
    reads "a place" (set "goPos" [ place home ] ~named:[ ("speed", i 12) ]) "goPos"
      [ ("position", Place home); number "speed" 12. ];
    reads "latitude and longitude" (set "goPos" [ n home.latitude; n home.longitude ]) "goPos"
      [ ("position", Place { home with height = 0. }) ];
    reads "metres" (set "move" [ i 10; i 20; i 5 ]) "move"
      [ number "north" 10.; number "east" 20.; number "up" 5. ];
    reads "a place and metres" (set "move" [ place home ] ~named:[ ("north", i 10) ]) "move"
      [ ("position", Place home); number "north" 10. ];
    reads "nothing" (set "capturePhoto" []) "capturePhoto" [];
    reads "a disc" (set "surveyArea" [ Area (Result.get_ok (Area.circle home 50.)); i 10 ]) "surveyArea"
      [ ("area", Places (Survey.around home ~radius:50.)); number "spacing" 10. ];
    reads "a polygon" (set "surveyArea" [ Area corridor; i 10 ]) "surveyArea"
      [ ("area", Places (Area.corners corridor)); number "spacing" 10. ];
    case "its name and whose it is" (fun () ->
        let m = built [ set "planName" [ str "photos" ]; set "vehicles" [ str "a"; str "b"; str "a" ]; set "move" [] ] in
        Alcotest.(check (pair string (list string))) "name, vehicles" ("photos", [ "a"; "b" ]) (m.name, m.vehicles);
        Alcotest.(check string) "without a name" "p" (built [ set "move" [] ]).name);
    case "what it needs" (fun () ->
        let needs words = Mission_plan.required_payload (built (List.map (fun w -> set w []) words)) in
        Alcotest.(check (list (list string))) "payload" [ [ "Camera" ]; [ "Camera" ]; [] ]
          [ needs [ "move"; "capturePhoto" ]; needs [ "captureUntilStop" ]; needs [ "move"; "stopCapturing" ] ]);
    case "where it begins" (fun () ->
        let reference settings = Mission_plan.reference (built settings) in
        Alcotest.(check (option near)) "goPos" (Some home) (reference [ set "takeOff" [ i 9 ]; set "goPos" [ place home ] ]);
        Alcotest.(check (option near)) "nowhere" None (reference [ set "takeOff" [ i 9 ]; set "returnHome" [] ])) ]

(* {1 Faults} *)

let fault ?(site = 0) message settings =
  case message (fun () ->
      match build settings with
      | Ok _ -> Alcotest.failf "accepted; should say: %s" message
      | Error fault -> Alcotest.(check (pair int string)) "fault" (site, message) (fault.site, fault.message))

let corners places = List (Vector.of_list (List.map place places))

let faults =
  [ fault "a mission has no item 'goPoss': did you mean goPos?" [ set "goPoss" [] ];
    fault ~site:plan_site "mission 'p' has no item, such as takeOff or goPos" [];
    fault ~site:plan_site "mission 'p' has no item, such as takeOff or goPos"
      [ set "arm" [ Boolean true ]; set "altitude" [ i 3 ] ];
    fault "name takes one string" [ set "planName" [] ];
    fault "takeOff lacks its altitude" [ set "takeOff" [] ];
    fault "altitude of takeOff is greater than 0 and at most 100000 m, not 0" [ set "takeOff" [ i 0 ] ];
    fault "takeOff takes altitude, not 2 arguments" [ set "takeOff" [ i 1; i 2 ] ];
    fault "takeOff has its argument 'altitude' twice" [ set "takeOff" [ i 1 ] ~named:[ ("altitude", i 2) ] ];
    fault "returnHome takes its arguments by name only" [ set "returnHome" [ i 1 ] ];
    fault "returnHome has no argument 'hight': it takes altitude, speed" [ set "returnHome" [] ~named:[ ("hight", i 1) ] ];
    fault "capturePhoto takes no arguments" [ set "capturePhoto" [ i 1 ] ];
    fault "capturePhoto takes no arguments, such as 'count'" [ set "capturePhoto" [] ~named:[ ("count", i 1) ] ];
    fault "expected a position as position of goPos, found a number, 3" [ set "goPos" [ i 3 ] ];
    fault "latitude 91 is not from -90 to 90 degrees" [ set "goPos" [ i 91; i 3 ] ];
    fault "speed is greater than 0 and at most 100 m/s, not 0" [ set "speed" [ i 0 ] ];
    fault "expected true or false as arm, found a string, 'yes'" [ set "arm" [ str "yes" ] ];
    fault "count of captureSeveralPhotos is a whole number, not 1.5" [ set "captureSeveralPhotos" [ n 1.5 ] ];
    fault "loiterPos goes on for a number of turns or of seconds, not both: leave out turns or duration"
      [ set "loiterPos" [] ~named:[ ("turns", i 2); ("duration", i 2) ] ];
    fault ~site:2 "jumpToItem 3: the mission has 2 items (arm and altitude do not count)"
      [ set "arm" [ Boolean true ]; set "move" []; set "jumpToItem" [ i 3 ] ];
    fault "area of surveyArea has three corners or more, not 2" [ set "surveyArea" [ corners [ home; moved 1. 0. ] ] ];
    fault "expected an area or a list of positions as area of surveyArea, found a number, 1"
      [ set "surveyArea" [ i 1 ] ];
    fault "spacing of surveyArea is too small: 0.01 m makes 10000 lines, more than 2000"
      [ set "surveyArea" [ corners [ home; moved 100. 0.; moved 100. 100.; moved 0. 100. ]; n 0.01 ] ] ]

(* {1 Reports of check} *)

let literally what expected setting arguments =
  case what (fun () ->
      Alcotest.(check (option string)) what expected (Mission_builder.literal_fault setting arguments))

let literals =
  [ literally "all known" (Some "speed is greater than 0 and at most 100 m/s, not 0") "speed" [ (None, Some (i 0)) ];
    literally "not known" None "speed" [ (None, None) ];
    literally "one of two" (Some "yaw of takeOffWithYaw is from -360 to 360 degrees, not 400") "takeOffWithYaw"
      [ (None, None); (None, Some (i 400)) ];
    literally "their number" (Some "takeOff takes altitude, not 2 arguments") "takeOff" [ (None, None); (None, None) ];
    literally "their names" (Some "goPos has no argument 'sped': did you mean speed?") "goPos"
      [ (None, None); (Some "sped", None) ];
    literally "what may be a position" None "move" [ (None, None); (Some "north", Some (i 3)) ];
    literally "latitude and longitude" None "goPos" [ (None, None); (None, Some (i 3)) ] ]

(* {1 The way} *)

let path settings = Mission_plan.path ~from:home ~speed:10. (built settings)
let visits settings = List.concat_map (fun (l : Mission_plan.leg) -> l.waypoints) (path settings)
let dwells settings = List.map (fun (l : Mission_plan.leg) -> l.dwell) (path settings)

let goes what settings offsets =
  case what (fun () -> Alcotest.(check (list near)) what (List.map (fun (n, e) -> moved n e) offsets) (visits settings))

let stays what settings expected =
  case what (fun () -> Alcotest.(check (list (float 1e-6))) what expected (dwells settings))

let ways =
  [ goes "from where it is then" [ set "move" [ i 10; i 0 ]; set "move" [ i 0; i 5 ]; set "moveFromHome" [ i 1; i 1 ] ]
      [ (10., 0.); (10., 5.); (1., 1.) ];
    goes "home" [ set "goPos" [ place (moved 100. 0.) ]; set "returnHomeAndLand" [] ] [ (100., 0.); (0., 0.) ];
    goes "another home" [ set "home" [ place (moved 50. 0.) ]; set "returnHome" [] ] [ (50., 0.) ];
    goes "a jump" [ set "move" [ i 1; i 0 ]; set "moveFromHome" [ i 9; i 9 ]; set "jumpToItem" [ i 1; i 2 ]; set "returnHome" [] ]
      [ (1., 0.); (9., 9.); (10., 9.); (9., 9.); (10., 9.); (9., 9.); (0., 0.) ];
    goes "a survey"
      [ set "surveyArea" [ corners [ home; moved 100. 0.; moved 100. 40.; moved 0. 40. ]; i 20 ] ]
      [ (0., 10.); (100., 10.); (100., 30.); (0., 30.) ];
    stays "for a time"
      [ set "loiterTime" [ i 30 ]; set "delay" [ i 5 ]; set "loiterTurns" [ i 2 ] ~named:[ ("radius", i 10) ];
        set "loiterPos" []; set "move" [] ]
      [ 30.; 5.; 4. *. Float.pi; infinity; 0. ];
    stays "without end, at the end" [ set "loiterPos" [ place home ] ] [ 0. ];
    case "at the altitude that it says, home being at 0" (fun () ->
        let heights settings =
          List.concat_map
            (fun (l : Mission_plan.leg) ->
               l.level.stays_at :: List.map (fun (p : Position.t) -> p.height) l.waypoints) (path settings) in
        Alcotest.(check (list (float 0.))) "heights" [ 30.; 30.; 30.; 20.; 20.; 25.; 25.; 0.; 0. ]
          (heights
             [ set "takeOff" [ i 30 ]; set "move" []; set "altitude" [ i 20 ]; set "move" [ i 9 ];
               set "move" [ i 0; i 0; i 5 ]; set "returnHomeAndLand" [] ]);
        let rounds = path [ set "move" [ i 0; i 0; i 5 ]; set "jumpToItem" [ i 1; i 2 ] ] in
        let unit = (List.hd rounds).level.measured_from in
        Alcotest.(check bool) "round by round nobody knows" true (unit = Plan.Unspecified));
    case "at the speed that it says" (fun () ->
        let speeds = List.map (fun (l : Mission_plan.leg) -> l.speed)
            (path [ set "move" []; set "speed" [ i 3 ]; set "move" []; set "move" [] ~named:[ ("speed", i 4) ] ]) in
        Alcotest.(check (list (float 0.))) "speeds" [ 10.; 3.; 3.; 4. ] speeds);
    case "a jump for ever has no end" (fun () ->
        let legs = path [ set "move" [ i 1 ]; set "jumpToItem" [ i 1; i (-1) ] ] in
        let last = List.nth legs (List.length legs - 1) in
        Alcotest.(check (float 0.)) "dwell" infinity last.dwell);
    case "every word is carried out" (fun () ->
        (* Items that take neither way nor time. *)
        let still =
          [ "name"; "vehicles"; "arm"; "altitude"; "stored"; "home"; "speed"; "takeOff"; "takeOffWithYaw"; "capturePhoto";
            "captureSeveralPhotos"; "captureUntilStop"; "stopCapturing"; "jumpToItem" ]
        in
        let arguments =
          [ ("north", Mission_plan.Number 5.); ("duration", Number 5.); ("position", Place (moved 9. 9.));
            ("area", Places [ home; moved 100. 0.; moved 0. 100. ]) ]
        in
        let moves (word, _) =
          let m = { Mission_plan.name = ""; vehicles = []; items = [ { word; arguments } ] } in
          List.exists
            (fun (l : Mission_plan.leg) -> l.waypoints <> [] || l.dwell > 0.)
            (Mission_plan.path ~from:home ~speed:1. m)
        in
        let others = List.filter (fun (word, _) -> not (List.mem word still)) Mission_builder.vocabulary in
        Alcotest.(check (list string)) "not carried out" []
          (List.map fst (List.filter (fun x -> not (moves x)) others))) ]

let () =
  Alcotest.run "missions" [ ("items", items); ("faults", faults); ("literals", literals); ("ways", ways) ]
