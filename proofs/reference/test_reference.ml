(* The function that proofs/ is about, extracted, has the transitions of Dolphin_semantics.Transition: the same in the
   same order, along random runs of random programs. *)

open Dolphin_semantics
open Test_support
module Gen = QCheck2.Gen

(* Without the places that the calculus does not have. *)
let plain (c : Configuration.t) =
  let vehicles = List.map fst (Vehicle_map.bindings c.shared.allocation) in
  Terms.to_configuration ~vehicles (Terms.configuration c)

(* The code stops vehicles in the order of their names, the calculus in that of the residual. *)
let rec effects : Effect.t list -> string list = function
  | (Stop _ :: _) as all ->
    let rec stops found : Effect.t list -> string list * Effect.t list = function
      | Stop v :: rest -> stops (v :: found) rest
      | rest -> (List.sort String.compare found, rest)
    in
    let found, rest = stops [] all in
    List.map (fun v -> "stop " ^ v) found @ effects rest
  | e :: rest -> Format.asprintf "%a" Effect.pp e :: effects rest
  | [] -> []

let same (t : Transition.t) (t' : Transition.t) =
  List.map Rule.name t.rules = List.map Rule.name t'.rules
  && Label.equal t.label t'.label
  && Configuration.equal (plain t.next) (plain t'.next)
  && effects t.effects = effects t'.effects

let show (t : Transition.t) =
  Format.asprintf "%s: %a ! %s" (String.concat ", " (List.map Rule.name t.rules)) Label.pp t.label
    (String.concat "; " (effects t.effects))

let differ what ts ts' =
  let all ts = String.concat "\n  " (List.map show ts) in
  QCheck2.Test.fail_reportf "%s:\n  %s\nextracted:\n  %s" what (all ts) (all ts')

(* Events that are awaited, and some that are not. *)
let events program world c : Transition.event list =
  let of_awaited : Transition.awaited -> Transition.event list = function
    | End_of v -> [ Vehicle_done v; Vehicle_failed (v, "why") ]
    | Expiry_of i -> [ Timer_expired i ]
    | Answer_to (i, _) -> [ Confirmed (i, Ok true); Confirmed (i, Ok false); Confirmed (i, Error "why") ]
    | Recruit_for _ -> []
    | Answer -> [ Nobody_answers "why" ]
    | Reply -> [ Replied (Integer 1); Host_failed "why" ]
  in
  List.concat_map of_awaited (Transition.awaited c)
  @ List.of_seq (Transition.recruitable program world c)
  @ [ Interruption; Timer_expired 0; Timer_expired 7; Vehicle_done "a"; Recruited (1, "b"); Input ("a", Integer 1) ]

let compared = ref 0
let with_keys = ref 0
let with_ends = ref 0

let agree program world c =
  let compare what ts ts' =
    Property.count compared;
    if List.compare_lengths ts ts' <> 0 || not (List.for_all2 same ts ts') then differ what ts ts' in
  let all steps = List.of_seq steps in
  compare "by itself" (all (Transition.internal program world c)) (all (Reference.internal program world c));
  let on_event event =
    let all accepted = Option.to_list (Result.to_option accepted) in
    compare "by an event"
      (all (Transition.accept program world c event))
      (all (Reference.accept program world c event))
  in
  ( match (Terms.configuration c).control_of with
    | Exec (_, r) ->
      if Interpreter.keys Terms.names r <> [] then Property.count with_keys;
      if Interpreter.ensured Terms.names r <> [] then Property.count with_ends
    | Script _ | Wait _ | End _ -> () );
  List.iter on_event (events program world c)

let along (ast, choices) =
  let program = Generate.compile ast and world = Generate.world in
  let walk = Walk.run ~choices program world in
  let configurations =
    Configuration.initial program :: List.map (fun (s : Walk.step) -> s.transition.next) walk in
  List.iter (agree program world) configurations;
  true

let print (ast, choices) = Generate.print ast ^ "choices " ^ String.concat ", " (List.map string_of_int choices)

let most_were_compared () =
  Alcotest.(check bool) "there were many" true (!compared > 1_000);
  Alcotest.(check bool) "some with fresh keys" true (!with_keys > 20);
  Alcotest.(check bool) "some with ends" true (!with_ends > 20)

let nested = Gen.map (fun t -> Generate.executing t) (Generate.nested ~vehicles:Generate.vehicles ~depth:2)

(* PROGRAMS of each kind; for long comparisons. *)
let count = Option.value ~default:200 (Option.bind (Sys.getenv_opt "PROGRAMS") int_of_string_opt)

let () =
  let programs name of_one = Property.case ~count name ~print (Gen.pair of_one Walk.choices) along in
  Alcotest.run "reference"
    [ ( "the extracted function is Transition",
        [ programs "scripts and tasks" Generate.program; programs "copies of a task" Generate.replicated;
          programs "sensors" Generate.sensing_program; programs "nested tasks" nested;
          Alcotest.test_case "and had much to do" `Quick most_were_compared ] ) ]
