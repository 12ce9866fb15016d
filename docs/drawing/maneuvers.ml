open Dolphin_plans
open Dolphin_semantics
module Wgs84 = Dolphin_geo.Wgs84

(* {1 Ways} *)

(* Metres north and east of the maneuver's place. *)
type point = { north : float; east : float }

let place = Dolphin_geo.Place.apdl

let relative p =
  let metres = Wgs84.distance place p and bearing = Dolphin_geo.Angle.radians (Wgs84.bearing place p) in
  { north = metres *. cos bearing; east = metres *. sin bearing }

let compile source =
  let nobody path = Error (path ^ ": there are no other files") in
  let explain ds = failwith (Format.asprintf "%a" (Fmt.list (Dolphin_syntax.Diagnostic.pp ~source)) ds) in
  match snd (Dolphin_syntax.Include.program ~read:nobody ~file:"maneuvers.dol" source) with
  | Error ds -> explain ds
  | Ok ast -> (
      match Elaborate.program ~source_name:"maneuvers.dol" ast with Error ds -> explain ds | Ok (p, _) -> p)

(* The plan with this one maneuver, which stands at [place]. *)
let plan maneuver =
  let program = compile (Printf.sprintf "p = imcPlan { locate Location.APDL; %s }" maneuver) in
  let rec ended c =
    match Transition.internal program World.empty c () with
    | Seq.Nil -> c
    | Cons (t, _) -> ended t.Transition.next
  in
  let c = ended (Configuration.initial program) in
  let plan_of = function _, Core.Task (Platform { plan; _ }) -> plan | _ -> None in
  match List.find_map plan_of (Store.bindings c.shared.store) with
  | Some plan -> plan
  | None -> failwith ("no plan: " ^ maneuver)

let way ~from maneuver =
  let from = Wgs84.displace place ~north:from.north ~east:from.east in
  let legs = Inline_plan.path ~from ~speed:1. (plan maneuver) in
  List.concat_map (fun (leg : Inline_plan.leg) -> List.map relative leg.waypoints) legs

(* {1 What was recorded} *)

let recorded path name =
  let channel = open_in path in
  let rec lines found =
    match input_line channel with
    | line -> lines (line :: found)
    | exception End_of_file -> close_in channel; List.rev found
  in
  let point line =
    match String.split_on_char ',' line with
    | [ plan; _; north; east ] when plan = name ->
      Some { north = float_of_string north; east = float_of_string east }
    | _ -> None
  in
  List.filter_map point (lines [])

(* {1 Panels} *)

type mark = { from : point; upto : point; text : string }

(* [circle] is the radius of the circles that only real vehicles make there. *)
type panel = {
  title : string;
  from : point;
  maneuver : string;
  flown : point list;
  circle : float option;
  marks : mark list;
}

let width = 340. and height = 300.
let spare = 46.  (* above the drawing, for the title *)

let escape text =
  let replace c by text = String.concat by (String.split_on_char c text) in
  text |> replace '&' "&amp;" |> replace '<' "&lt;" |> replace '>' "&gt;"

(* A tenth of a pixel, the same on each machine: nothing lies on the edge between two tenths. *)
let tenth x = x +. 1e-6

(* The positions of points in the drawing: all of them within the panel, north above. *)
let scale points =
  let all f = List.map f points in
  let least xs = List.fold_left Float.min infinity xs and most xs = List.fold_left Float.max neg_infinity xs in
  let south = least (all (fun p -> p.north)) and north = most (all (fun p -> p.north)) in
  let west = least (all (fun p -> p.east)) and east = most (all (fun p -> p.east)) in
  let margin = 30. in
  let high = Float.max 1. (north -. south) and wide = Float.max 1. (east -. west) in
  let factor = Float.min ((width -. (2. *. margin)) /. wide) ((height -. spare -. (2. *. margin)) /. high) in
  let middle = (width -. (factor *. wide)) /. 2. and upper = (height -. spare -. (factor *. high)) /. 2. in
  let drawn p =
    (tenth (middle +. (factor *. (p.east -. west))), tenth (spare +. upper +. (factor *. (north -. p.north))))
  in
  (factor, drawn)

let dot points cls at =
  let one p =
    let x, y = at p in
    Printf.sprintf {|<circle class="%s" cx="%.1f" cy="%.1f" r="2"/>|} cls x y
  in
  List.map one points

let polyline at cls points =
  let one p = let x, y = at p in Printf.sprintf "%.1f,%.1f" x y in
  Printf.sprintf {|<polyline class="%s" points="%s"/>|} cls (String.concat " " (List.map one points))

(* An arrowhead in the middle of each part that is long enough to bear one. *)
let arrows at points =
  let arrow p q =
    let x, y = at p and x', y' = at q in
    let length = Float.hypot (x' -. x) (y' -. y) in
    if length < 16. then None
    else
      let degrees = tenth (Dolphin_geo.Angle.degrees (Float.atan2 (y' -. y) (x' -. x))) in
      Some
        (Printf.sprintf {|<path class="head" d="M-4,-4 L4,0 L-4,4 z" transform="translate(%.1f,%.1f) rotate(%.1f)"/>|}
           ((x +. x') /. 2.) ((y +. y') /. 2.) degrees)
  in
  let rec go = function p :: (q :: _ as rest) -> arrow p q :: go rest | [ _ ] | [] -> [] in
  List.filter_map Fun.id (go points)

let mark at { from; upto; text } =
  let x, y = at from and x', y' = at upto in
  let upright = Float.abs (x -. x') < Float.abs (y -. y') in
  let dx, dy, anchor = if upright then (6., 4., "start") else (0., -5., "middle") in
  [ Printf.sprintf {|<line class="mark" x1="%.1f" y1="%.1f" x2="%.1f" y2="%.1f"/>|} x y x' y';
    Printf.sprintf {|<text class="note" x="%.1f" y="%.1f" text-anchor="%s">%s</text>|}
      (((x +. x') /. 2.) +. dx) (((y +. y') /. 2.) +. dy) anchor (escape text) ]

(* A line of code in as many lines as fit. *)
let code text =
  let add lines word =
    match lines with
    | line :: rest when String.length line + String.length word < 50 -> (line ^ " " ^ word) :: rest
    | lines -> word :: lines
  in
  List.rev (List.fold_left add [] (String.split_on_char ' ' text))

let panel p =
  let planned = p.from :: way ~from:p.from p.maneuver in
  let here = { north = 0.; east = 0. } in
  let reach = Option.value p.circle ~default:0. in
  let around = [ { north = reach; east = reach }; { north = -.reach; east = -.reach } ] in
  let marked = List.concat_map (fun (m : mark) -> [ m.from; m.upto ]) p.marks in
  let factor, at = scale (here :: p.from :: (around @ planned @ p.flown @ marked)) in
  let x, y = at here and x', y' = at p.from in
  let circle r = Printf.sprintf {|<circle class="real" cx="%.1f" cy="%.1f" r="%.1f"/>|} x y (r *. factor) in
  let line i text = Printf.sprintf {|<text class="code" x="8" y="%d">%s</text>|} (29 + (13 * i)) (escape text) in
  (Printf.sprintf {|<text class="title" x="8" y="15">%s</text>|} (escape p.title) :: List.mapi line (code p.maneuver))
  @ List.map circle (Option.to_list p.circle)
  @ dot p.flown "flown" at
  @ [ polyline at "way" planned ]
  @ arrows at planned
  @ List.concat_map (mark at) p.marks
  @ [ Printf.sprintf {|<path class="place" d="M%.1f,%.1f h10 m-5,-5 v10"/>|} (x -. 5.) y;
      Printf.sprintf {|<circle class="start" cx="%.1f" cy="%.1f" r="3.5"/>|} x' y' ]

let style =
  String.concat "\n"
    [ "svg{background:#fff;font:12px sans-serif}";
      ".title{font-weight:bold;fill:#222}";
      ".code{font:11px monospace;fill:#333}";
      ".way{fill:none;stroke:#1f6fb2;stroke-width:1.6}";
      ".head{fill:#1f6fb2}";
      ".flown{fill:#d1632a;fill-opacity:.75}";
      ".real{fill:none;stroke:#777;stroke-dasharray:4 3}";
      ".mark{stroke:#777;stroke-width:1}";
      ".note{font-size:11px;fill:#555}";
      ".place{stroke:#222;stroke-width:1.6}";
      ".start{fill:#fff;stroke:#1f6fb2;stroke-width:1.6}";
      ".frame{fill:none;stroke:#ddd}" ]

let drawing ~label ~legend panels =
  let columns = 2 in
  let rows = (List.length panels + columns - 1) / columns in
  let wide = float_of_int columns *. width and high = (float_of_int rows *. height) +. 24. in
  Printf.printf {|<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %.0f %.0f" width="%.0f" height="%.0f"|} wide high
    wide high;
  Printf.printf {| role="img" aria-label="%s">|} (escape label);
  Printf.printf "\n<style>%s</style>\n" style;
  let one i p =
    let x = float_of_int (i mod columns) *. width and y = float_of_int (i / columns) *. height in
    Printf.printf {|<g transform="translate(%.0f,%.0f)">|} x y;
    Printf.printf {|<rect class="frame" width="%.0f" height="%.0f"/>|} width height;
    List.iter (Printf.printf "\n%s") (panel p);
    print_string "\n</g>\n"
  in
  List.iteri one panels;
  Printf.printf {|<text class="note" x="8" y="%.0f">%s</text>|} (high -. 8.) (escape legend);
  print_string "\n</svg>\n"

(* {1 The drawings} *)

let at north east = { north; east }

let rows path =
  let recorded = recorded path in
  let one title name ?(marks = []) arguments =
    let flown = recorded name in
    let from = match flown with first :: _ -> first | [] -> at (-20.) (-10.) in
    let maneuver = "rows width: 60, length: 80, hstep: 20, coff: 5" ^ arguments in
    { title; from; maneuver; flown; circle = None; marks }
  in
  let sizes =
    [ { from = at 0. 9.; upto = at 80. 9.; text = "length" }; { from = at 80. 14.; upto = at 85. 14.; text = "coff" };
      { from = at 92. (-20.); upto = at 92. 0.; text = "hstep" };
      { from = at (-21.) (-60.); upto = at (-21.) 0.; text = "width" } ]
  in
  drawing ~label:"Ways of rows"
    ~legend:"line: simulated, from the circle; cross: the place; dots: a real DUNE, every 5 s; north is above"
    [ one "firstCurveRight: false, as without it" "left" ~marks:sizes "";
      one "firstCurveRight: true" "right" ", firstCurveRight: true";
      one "bearing and cross_angle" "turned" ", firstCurveRight: true, bearing: 45, cross_angle: 20";
      one "alternation and squareCurve" "alternation" ", firstCurveRight: true, alternation: 50, squareCurve: false" ]

let others () =
  let from = at (-60.) (-80.) in
  let one ?(from = from) ?circle ?(marks = []) title maneuver = { title; from; maneuver; flown = []; circle; marks } in
  let radius = { from = at 0. 0.; upto = at 0. 20.; text = "radius" } in
  drawing ~label:"Ways of the other maneuvers"
    ~legend:"line: simulated, from the circle; cross: the place; dashed: what real vehicles do; north is above"
    [ one "goTo, launch, yoyo: to the place" "goTo()";
      one "followPath: points from the place" "followPath points: [[40, 0], [40, 60], [-20, 60], [-20, 20]]";
      one "loiter: around the place" ~circle:20. ~marks:[ radius ] "loiter radius: 20, duration: 60";
      one "skeeping: within the radius, drifting" ~circle:20. ~marks:[ radius ] "skeeping radius: 20, duration: 60";
      one "compassCalibration: around the place" ~circle:5. "compassCalibration radius: 5, duration: 300";
      one "popup: up where it is, or at the place" "popup currPos: false, waitAtSurface: true, duration: 180" ]

let () =
  match Array.to_list Sys.argv with
  | [ _; "rows"; path ] -> rows path
  | [ _; "others" ] -> others ()
  | _ -> failwith "usage: maneuvers.exe rows RECORDED | others"
