(* On random programs, bitstate hashing in an array that is large enough finds what the search that keeps all states
   finds: as many states and transitions, the same properties broken, by runs of the semantics; all else is
   inconclusive. PROGRAMS in the environment is how many programs are tried, 500 by default. *)

open Dolphin_semantics
open Dolphin_environment
open Dolphin_checker
open Dolphin_explore
module Generate = Test_support.Generate

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 500
let limit = 1_000

(* So large that a state of [limit] is left out in none of billions of programs. *)
let bytes = 1 lsl 20

let twice = Result.get_ok (Faults.of_string "all=2")

let environments =
  let losing loss = { Environment.default with faults = { Faults.none with loss } } in
  [ ("as planned", Environment.default); ("with failures", Environment.failing Environment.default);
    ("with a failure", Environment.failing ~failures:1 Environment.default); ("with losses", losing Any_number);
    ("with all faults, twice", { Environment.default with faults = twice });
    ("with interruptions", { Environment.default with faults = { Faults.none with interrupt = true } }) ]

let case =
  let open QCheck2.Gen in
  let program = frequency [ (2, Generate.program); (1, map Generate.for_ever Generate.program) ] in
  triple program (oneofl environments) (oneofl [ Reduction.Whole; Partial_order; Symmetry; All ])

let print (program, (name, _), reduction) =
  Printf.sprintf "%s, reduced by %s:\n%s" name (String.concat ", " (Reduction.names reduction))
    (Generate.print program)

(* Each transition is offered where the run is; a cycle comes back. *)
let is_run program environment (run : Search.run) =
  let step states (t : Transition.t) =
    let leads ((t' : Transition.t), e) =
      if Configuration.equal t'.next t.next && Label.equal t'.label t.label then Some (t'.next, e) else None
    in
    let offered (c, e) = Seq.filter_map leads (Environment.choices environment program Generate.world e c) in
    List.concat_map (fun state -> List.of_seq (offered state)) states
  in
  let there = List.fold_left step [ (Configuration.initial program, Environment.initial) ] run.steps in
  let back = List.fold_left step there run.cycle in
  let same (c, e) (c', e') = Configuration.equal c c' && Environment.compare e e' = 0 in
  List.exists (fun state -> List.exists (same state) back) there

let broken = Hashtbl.create 8
let skipped = ref 0

let fail format = Printf.ksprintf QCheck2.Test.fail_report format

(* Whether a task may go round, by words that it takes. *)
let may_go_round ast =
  let text = Generate.print ast in
  let has word = Str.string_match (Str.regexp (".*" ^ word)) (String.map (function '\n' -> ' ' | c -> c) text) 0 in
  has "repeat" || has "retry" || has "withBreaks" || has "onlyWhile"

let compare_verdicts program environment ast exact found =
  let compare_one (property, (verdict : Search.verdict)) =
    let name = Property.name property in
    match verdict, (List.assoc property found : Search.verdict) with
    | Violated _, Violated run ->
      Hashtbl.replace broken property ();
      let environment = Later_picks.forgetting program environment in
      if not (is_run program environment run) then fail "%s: this is no run" name
    | Violated _, Inconclusive Hashed when property = Termination && may_go_round ast -> ()
    | (Holds | Holds_if _ | By_design _ | Unreached _), Inconclusive Hashed -> ()
    | _, _ -> fail "%s: another verdict" name
  in
  List.iter compare_one exact

let agrees (ast, (_, environment), reduction) =
  let program = Generate.compile ast in
  let limits = { Limits.none with max_states = Some limit } in
  let options = { Search.default with environment; reduction; limits; search_again = 0; spare_bits = Some 0 } in
  let exact = Search.run options program Generate.world in
  if exact.stopped <> None then incr skipped
  else begin
    let found = Search.run { options with bitstate = Some bytes } program Generate.world in
    (* Which of several states stands for all those of tasks may depend on which was found first. *)
    (match reduction with
     | Whole | Vehicles | Partial_order ->
       if (found.states, found.transitions) <> (exact.states, exact.transitions) then
         fail "%d states and %d transitions, not %d and %d" found.states found.transitions exact.states
           exact.transitions
     | Symmetry | All -> ());
    compare_verdicts program environment ast exact.verdicts found.verdicts
  end;
  true

let test_agreement () =
  let test = QCheck2.Test.make ~count:programs ~print ~name:"bitstate hashing agrees" case agrees in
  Test_support.Property.on_each_seed ~usual:20_261_130 ~programs test;
  Printf.printf "%d skipped, of more than %d states\n" !skipped limit;
  if Hashtbl.length broken = 0 then Alcotest.fail "no program breaks anything"

(* {1 One by one} *)

let explored ?(options = Search.default) ?(bytes = bytes) text =
  Search.run { options with bitstate = Some bytes } (Test_support.Pure_run.compile_exn text) Generate.world

(* A cycle through the script, which vehicles and tasks that are alike take part in. *)
let test_cycle () =
  let text =
    "va = pick { count 1 }\nvb = pick { count 1 }\nn = 0\npause 2\n\
     while (n < 3) { execute task('p')[va] | task('p')[vb]\nn = 3 - n\nn = 3 - n }"
  in
  let program = Test_support.Pure_run.compile_exn text in
  let is_shown reduction =
    let found = Search.run { Search.default with reduction; bitstate = Some bytes } program Generate.world in
    match List.assoc Property.Termination found.verdicts with
    | Violated run ->
      Alcotest.(check bool) "a run" true (run.cycle <> [] && is_run program Environment.default run)
    | Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _ -> Alcotest.fail "no cycle was found"
  in
  List.iter is_shown [ Reduction.Whole; Partial_order; Symmetry; All ]

(* The run to a state in which an invariant does not hold is kept. *)
let test_invariant () =
  let text = "n = 0\nwhile (n < 9) { n = n + 1 ; pause 1 }" in
  let program = Test_support.Pure_run.compile_exn text in
  let invariants = List.map (fun text -> Result.get_ok (Condition.of_string program text)) [ "n < 5"; "n < 20" ] in
  let found = Search.run { Search.default with invariants; bitstate = Some bytes } program Generate.world in
  match List.filter (function Property.Invariant _, _ -> true | _ -> false) found.verdicts with
  | [ (_, Violated run); (_, Inconclusive Hashed) ] ->
    Alcotest.(check bool) "a run" true (is_run program Environment.default run)
  | _ -> Alcotest.fail "other verdicts"

(* With too few bits, no property is reported to hold, and no count is too large. *)
let test_too_few () =
  let text = "execute (idle(1) >> idle(2) >> idle(3)) | (idle(1) >> idle(2) >> idle(3)) | (idle(1) >> idle(2))" in
  let options = { Search.default with reduction = Whole } in
  let found = explored ~options ~bytes:8 text and all = explored ~options text in
  Alcotest.(check bool) "some are left out" true (found.states < all.states);
  let omission (o : Search.outcome) = (Option.get o.bitstate).omission in
  Alcotest.(check bool) "and it says so" true (omission found > 0.5 && omission all < 1e-6);
  let is_inconclusive (_, verdict) = verdict = Search.Inconclusive Hashed in
  Alcotest.(check bool) "nothing holds" true (List.for_all is_inconclusive found.verdicts)

let () =
  Alcotest.run "bitstate"
    [ ( "programs",
        [ Alcotest.test_case "a cycle" `Quick test_cycle;
          Alcotest.test_case "an invariant" `Quick test_invariant;
          Alcotest.test_case "too few bits" `Quick test_too_few ] );
      ("random programs", [ Alcotest.test_case "as the search that keeps all states" `Quick test_agreement ]) ]
