(* Constant plans: [check] knows each error that building one ends with, and no other.

   A plan within a function that takes its description is not constant: its words are checked, and it is built when
   the program runs. The same plan with that description in its place is constant: it is built by [check] too. *)

open Dolphin_semantics
open Test_support
module Diagnostic = Dolphin_syntax.Diagnostic

let constants = "n = 90000\nhere = location(41.19, -8.70)\ndepth = -1.m\n"

(* The places of a plan, as the program around it. *)
let places =
  [ ("p = ", ""); ("p = task('a') >> ", ""); ("p = [", "]"); ("p = true ? ", " : null"); ("def f() { ", " }\np = f()");
    ("p = [1].collect { ", " }") ]

let constant (located, (before, after), body) =
  Printf.sprintf "%s%s%simcPlan { description 'd'; %s }%s\n" constants located before body after

let in_function (located, _, body) =
  Printf.sprintf "%s%sdef f(q) { imcPlan { description q; %s } }\np = f('d')\n" constants located body

(* {1 Plans} *)

let right = function
  | "id" -> [ "'a'"; "'b'"; "'c'"; "'d'" ]
  | "location" -> [ "Location.APDL"; "location(41.19, -8.70)" ]
  | "payload" -> [ "[[name: 'Camera', Frequency: 50]]"; "[name: 'DVL']" ]
  | "points" -> [ "[[0, 0], [100, 50]]"; "[[north: 1, east: 2]]" ]
  | "direction" -> [ "'CLOCKW'"; "'VDEP'" ]
  | "currPos" | "squareCurve" -> [ "true"; "false" ]
  | "duration" -> [ "30"; "2.min"; "0" ]
  | _ -> [ "2"; "5"; "10"; "1.5" ]

let right_positional = function
  | "planName" | "description" -> [ "'name'" ]
  | "vehicles" -> [ "'noptilus-1'"; "'noptilus-1', 'noptilus-2'" ]
  | "speed" -> [ "1.2"; "900, Speed.Units.RPM"; "50, 'percentage'" ]
  | "z" -> [ "3"; "20, Z.Units.ALTITUDE" ]
  | "locate" -> [ "Location.APDL"; "41.19, -8.70" ]
  | "move" -> [ "100, -50" ]
  | _ -> [ "1" ]

let wrong =
  [ "0"; "-5"; "50"; "255"; "90000"; "0.5"; "1e9"; "12.min"; "80.percent"; "null"; "true"; "''"; "'CLOCKWISE'"; "'rpm'";
    "[]"; "[1]"; "[[0, 'x']]"; "[nort: 1]"; "location(41.19, -8.70)"; "Speed.Units.RPM"; "Z.Units.HEIGHT"; "_"; "1 / 0"; "n"; "here"; "depth";
    "'a' + 1"; "[1, 2].size()"; "location(100, 0)" ]

let mostly good = QCheck2.Gen.(frequency [ (6, oneofl good); (1, oneofl wrong) ])

let setting =
  let open QCheck2.Gen in
  let* name, arguments = oneofl Plan_builder.vocabulary in
  if arguments = [] then
    let* values = frequency [ (8, map (fun x -> [ x ]) (mostly (right_positional name)));
                              (1, list_size (int_range 1 3) (oneofl wrong)) ] in
    return (name ^ " " ^ String.concat ", " values)
  else
    let argument =
      let* k = frequency [ (30, oneofl arguments); (1, return "raduis") ] in
      map (fun x -> k ^ ": " ^ x) (mostly (right k))
    in
    let* named = list_size (int_range 0 2) argument in
    let* positional = frequency [ (20, return []); (1, map (fun x -> [ x ]) (oneofl wrong)) ] in
    let needed = if name = "followPath" && named = [] then [ "points: [[0, 0], [100, 50]]" ] else [] in
    return (Printf.sprintf "%s(%s)" name (String.concat ", " (positional @ needed @ named)))

let plan =
  QCheck2.Gen.(triple (oneofl [ ""; "locate here\n" ]) (oneofl places) (map (String.concat "; ") (list_size (int_range 1 4) setting)))

(* {1 The law} *)

type verdict = Builds | Fails of string list

let checked source =
  match Pure_run.compile source with
  | Ok _ -> Builds
  | Error ds -> Fails (List.map (fun (d : Diagnostic.t) -> d.message) ds)

let built program =
  match Pure_run.last (Pure_run.run program) with
  | Some { control = Ended (Failed fault); _ } -> Fails [ fault.message ]
  | Some { control = Ended Completed; _ } -> Builds
  | Some _ | None -> failwith "the program does not end"

let plans = ref 0
let faults = ref 0

let law plan =
  let verdict = checked (constant plan) in
  match Pure_run.compile (in_function plan), verdict with
  | Error _, Fails _ -> true
  | Error _, Builds -> false
  | Ok program, _ -> (
      match built program, verdict with
      | Builds, Builds -> incr plans; true
      | Fails [ why ], Fails messages -> incr faults; List.mem why messages
      | _, _ -> false)

let enough () =
  Alcotest.(check bool) (Printf.sprintf "%d plans" !plans) true (!plans > 100);
  Alcotest.(check bool) (Printf.sprintf "%d faults of building" !faults) true (!faults > 100)

let () =
  Alcotest.run "constant plans"
    [ ("check and building",
       [ Property.case ~count:1500 "the same plans are refused, for the same reason" ~print:constant plan law;
         Alcotest.test_case "enough plans of both kinds" `Quick enough ]) ]
