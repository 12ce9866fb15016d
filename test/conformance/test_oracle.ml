(* The oracle writes the whole configuration; and no line makes it raise. *)

open Dolphin_semantics
open Dolphin_conformance
open Test_support
module Gen = QCheck2.Gen

let fail format = Printf.ksprintf (fun why -> QCheck2.Test.fail_report why) format
let text json = Dolphin_json.Canonical.to_string json

let written program c =
  match Snapshot.to_json program c with Ok json -> json | Error why -> failwith why

(* As it comes back from another process. *)
let carried json = Yojson.Safe.from_string (text json)

(* {1 Configurations are written down whole} *)

let walks = Gen.pair Generate.program Walk.choices
let print (program, _) = Generate.print program

let configurations program choices =
  let walk = Walk.run ~choices program Generate.world in
  Configuration.initial program :: List.map (fun (s : Walk.step) -> s.transition.next) walk

let along name property =
  Property.case ~count:300 name ~print walks (fun (program, choices) ->
      let program = Generate.compile program in
      let nodes = Nodes.of_program program in
      List.for_all (property program nodes) (configurations program choices))

let back program nodes c =
  match Snapshot.of_json nodes program (carried (written program c)) with
  | Ok c' -> c'
  | Error why -> fail "%s: not read again: %s" (text (written program c)) why

let comes_back program nodes c = Configuration.equal c (back program nodes c)

let is_one_text program nodes c = text (written program c) = text (written program (back program nodes c))

let successors program c =
  let show (t : Transition.t) =
    Format.asprintf "%a %s %s" Label.pp t.label (Pure_run.rules t) (text (written program t.next)) in
  List.map show (Graph.outcomes ~failures:true ~interruption:true program Generate.world c)

let does_the_same program nodes c = successors program c = successors program (back program nodes c)

(* Two walks of one program: configurations that differ are different texts, and equal ones are one. *)
let tells_apart =
  let two = Gen.triple Generate.program Walk.choices Walk.choices in
  Property.case ~count:200 "equal texts are equal configurations" ~print:(fun (p, _, _) -> Generate.print p) two
    (fun (program, choices, choices') ->
       let program = Generate.compile program in
       let cs = configurations program choices and cs' = configurations program choices' in
       let agree c c' = Configuration.equal c c' = (text (written program c) = text (written program c')) in
       List.for_all (fun c -> List.for_all (agree c) cs') cs)

(* {1 Every kind of value and of stack frame} *)

let rich =
  {|
def twice(f) { { x -> f(f(x)) } }
def sum(n) { if (n == 0) return 0
  def rest = sum(n - 1)
  n + rest }
v = pick { id 'noptilus-1' }
place = location(41.18, -8.7)
values = [null, true, 1, 1.5, 'text', [a: [1, 2]], 1..3, place, place ^ 200.m, v, twice({ it + 1 }),
  Speed.Units.RPM, 2.0 ** 0.5]
plans = [imcPlan('named'),
  imcPlan {
    planName 'all'; locate Location.APDL
    goTo speed: 2, payload: [[name: 'Sidescan', Range: 50]]
    loiter radius: 30
    skeeping duration: 60
    yoyo max_depth: 10
    popup duration: 20
    rows width: 100
    followPath points: [[1, 2], [3, 4, 5]]
    compassCalibration radius: 5
    launch()
  },
  mission {
    name 'items'; arm true; vehicles 'noptilus-1'
    takeOff 30
    goPos Location.APDL, north: 10, speed: 2
    surveyArea([Location.APDL, place, location(41.2, -8.7)], 500)
    stored 'other'
  }]
tasks = [action { post a: 1 }, condition { poll(a: 1) }, idle(1), plans[0] >> plans[1], plans[0][v], plans[0] | idle(2),
  allOf { when { true } then idle(1); when { true } then idle(2) }, oneOf { when { true } then idle(3) },
  until { false } run idle(4), during 5 run idle(5), during { 6 } run idle(6), watch idle(7) onError { ignore() }]
for (x in [3, 1, 2]) { [x].each { y -> message y + sum(2) } }
n = 0
while (n < 2) { n++; message([5, 6].collect { it + message(it).equals(null).toString().size() }.sum()) }
message([2, 1].sort { a -> message a; a })
message([1, 2].inject(0) { s, x -> message s; s + x })
message(values[10](1) + (values[11] ? 1 : 0))
answer = ask 'n?'
pause 2
s = getSupplier()
post answer: answer
execute tasks[0] >> plans[1]
|}

let every_kind () =
  let program = Pure_run.compile_exn rich in
  let nodes = Nodes.of_program program in
  let run = Pure_run.run ~answers:[ "n + 1" ] program in
  Alcotest.(check string) "it runs to its end" "completed" (Pure_run.ending run);
  let check (t : Transition.t) =
    let again = back program nodes t.next in
    Alcotest.(check bool) (Format.asprintf "after %a" Label.pp t.label) true (Configuration.equal t.next again);
    Alcotest.(check string) "one text" (text (written program t.next)) (text (written program again))
  in
  List.iter check run

let too_large source () =
  let program = Pure_run.compile_exn (source ^ "\nmessage 'm'") in
  match List.rev (Pure_run.run program) with
  | last :: _ -> (
      match Snapshot.to_json program last.next with
      | Ok _ -> Alcotest.fail "this task was written"
      | Error _ -> ())
  | [] -> Alcotest.fail "no run"

(* {1 Hostile lines} *)

let oracle source =
  let fleet = "vehicle 'noptilus-1', { type 'UUV' }" in
  let request = `Assoc [ ("request", `String "initial"); ("program", `String source); ("fleet", `String fleet) ] in
  let o, reply = Oracle.answer (Oracle.start ~name:"test") request in
  match reply with
  | `Assoc members -> (o, List.assoc "configuration" members)
  | _ -> Alcotest.fail "no configuration"

let step configuration : Yojson.Safe.t = `Assoc [ ("request", `String "step"); ("configuration", configuration) ]

(* All that differ from [json] in one place: something else there, or one item less, or two swapped. *)
let rec mutants (json : Yojson.Safe.t) : Yojson.Safe.t list =
  let other : Yojson.Safe.t list =
    [ `Null; `Int (-1); `Int 3; `Int 1_000_000; `String "x"; `String "task"; `List []; `Float 0.5; `Bool true ] in
  let inside =
    match json with
    | `List items ->
      let at i f = `List (List.concat (List.mapi (fun j x -> if i = j then f x else [ x ]) items)) in
      let each i x =
        at i (fun _ -> []) :: at i (fun x -> [ x; x ]) :: List.map (fun x -> at i (fun _ -> [ x ])) (mutants x) in
      List.concat (List.mapi each items)
    | `Assoc members ->
      let at i f = `Assoc (List.concat (List.mapi (fun j m -> if i = j then f m else [ m ]) members)) in
      let each i (name, x) =
        at i (fun _ -> []) :: List.map (fun x -> at i (fun _ -> [ (name, x) ])) (mutants x) in
      List.concat (List.mapi each members)
    | _ -> []
  in
  List.filter (fun other -> other <> json) other @ inside

let first_transition reply =
  match reply with
  | `Assoc members -> (
      match List.assoc_opt "transitions" members with
      | Some (`List (`Assoc t :: _)) -> List.assoc_opt "next" t
      | _ -> None)
  | _ -> None

(* The mutated configurations of a run are random; each has a reply. *)
let hostile () =
  let source =
    "v = pick { id 'noptilus-1' }\nfor (x in [1, 2]) { message([x].collect { it + 1 }) }\n\
     execute (watch (during 5 run task('p')[v]) onError { ignore() }) | \
     allOf { when { poll(a: _) } then idle(1); when { true } then action { post a: 1 } }" in
  let o, start = oracle source in
  let replies = ref 0 and refused = ref 0 in
  let ask configuration =
    match snd (Oracle.answer o (step configuration)) with
    | `Assoc members -> incr replies; if List.mem_assoc "error" members then incr refused
    | _ -> Alcotest.fail "a reply is no object"
  in
  let rec go n configuration =
    if n > 0 then begin
      (* Values in the clear are not read. *)
      (match configuration with
       | `Assoc members ->
         List.iter (fun state -> ask (`Assoc [ ("state", state) ])) (mutants (List.assoc "state" members))
       | _ -> ());
      match first_transition (snd (Oracle.answer o (step configuration))) with
      | Some next -> go (n - 1) next
      | None -> ()
    end
  in
  go 8 start;
  Alcotest.(check bool) (Printf.sprintf "most of %d are refused: %d" !replies !refused) true (2 * !refused > !replies)

let code line =
  match Yojson.Safe.from_string (snd (Oracle.answer_line (Oracle.start ~name:"test") line)) with
  | `Assoc members -> (
      match List.assoc_opt "error" members with
      | Some (`Assoc error) -> (match List.assoc "code" error with `String code -> code | _ -> "?")
      | _ -> "none")
  | _ -> "?"

let codes () =
  let check expected line =
    let shown = String.escaped (String.sub line 0 (min 60 (String.length line))) in
    Alcotest.(check string) shown expected (code line)
  in
  check "no-json" "{";
  check "no-json" "\xff\xfe";
  check "no-json" (String.make 30_000 '[');
  check "bad-request" "[]";
  check "bad-request" "{}";
  check "bad-request" {|{"request": 5}|};
  check "unknown-request" {|{"request": "jump"}|};
  check "bad-request" {|{"request": "initial", "program": ""}|};
  check "bad-request" {|{"request": "initial", "program": [], "fleet": ""}|};
  check "no-program" {|{"request": "step", "configuration": {}}|};
  check "none" {|{"request": "hello"}|};
  check "none" {|{"request": "initial", "program": "\u0000", "fleet": "\u0001"}|};
  check "no-json" {|{"request": "initial", "program": "\ud800", "fleet": ""}|};
  check "none" {|{"request": "initial", "program": "x = (", "fleet": ""}|}

let () =
  let case name f = Alcotest.test_case name `Quick f in
  Alcotest.run "oracle"
    [ ( "configurations",
        [ along "come back from text" comes_back; along "have one text" is_one_text;
          along "do the same when they are back" does_the_same; tells_apart; case "of every kind" every_kind;
          case "are not written if they are huge" (too_large "t = idle(1)\nfor (i in 1..30) { t = t >> t }");
          case "are not written if they are deep"
            (too_large "t = idle(1)\nfor (i in 1..6000) { t = t >> idle(1) }") ] );
      ("requests", [ case "have errors with codes" codes; case "of configurations that were tampered with" hostile ]) ]
