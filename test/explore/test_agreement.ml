(* On random programs, the packed search finds what the plain search over configurations finds: as many states and
   transitions, the same depth, the same properties broken, each by as short a run; and each run that it shows is one of
   the semantics. Of one program in three the states are compressed, of another they are on disk. PROGRAMS in the
   environment is how many programs are tried, 1,200 by default. *)

open Dolphin_explore
module Property = Dolphin_explore.Property

open Cases
module Environment = Dolphin_environment.Environment

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 1_200

let limit = 5_000
let skipped = ref 0
let broken = Hashtbl.create 7

let note property = Hashtbl.replace broken property (1 + Option.value (Hashtbl.find_opt broken property) ~default:0)

let verdict_agrees ?start program world environment ~goes_round reference (property, verdict) =
  match (verdict : Search.verdict), List.assoc_opt property reference with
  | (Holds | Holds_if _ | By_design _), None when goes_round && property = Property.Termination -> true
  | Violated run, None when goes_round && property = Property.Termination -> is_run ?start program world environment run
  | Holds, None -> true
  | Unreached _, None -> property = Property.All_reached
  | Violated run, Some length ->
    note property;
    let shown = List.length run.steps + List.length run.cycle in
    (shown = length || (property = Property.Termination && shown >= length))
    && is_run ?start program world environment run
  | (Holds | Holds_if _ | By_design _ | Violated _ | Unreached _ | Inconclusive _), (Some _ | None) -> false

let unsettled = ref 0

(* States go to disk at once: four fifths of the memory are always taken. *)
let on_disk : Dolphin_checker.Limits.t =
  let max_memory = 1_000_000_000_000 in
  let memory_taken () = Some (max_memory / 5 * 4) in
  { Dolphin_checker.Limits.none with max_memory = Some max_memory; memory_taken }

let agrees_from ?start ((ast, world), _, (_, environment)) program =
  match Reference.explore ~limit ?start environment program world with
  | None ->
    incr skipped;
    true
  | exception Dolphin_environment.Environment.Unclear _ ->
    incr unsettled;
    let o = Search.run ?start { Search.default with environment } program world in
    (match o.stopped with Some (Unsettled _) -> true | Some _ | None -> false)
  | Some reference ->
    let hash = Hashtbl.hash (Generate.print ast) in
    let spare_bits = if hash mod 2 = 0 then Some 0 else None in
    let kept =
      match hash / 2 mod 3 with
      | 0 -> Search.default
      | 1 -> { Search.default with compress = true }
      | _ -> { Search.default with spill = Some (Filename.get_temp_dir_name ()); limits = on_disk }
    in
    (* The runs that are found in the states, also those of no world. *)
    let o = Search.run ?start { kept with environment; spare_bits; search_again = 0 } program world in
    let same what expected found =
      if expected <> found then QCheck2.Test.fail_reportf "%d %s, %d expected" found what expected
    in
    same "states" (Array.length reference.states) o.states;
    same "transitions" (Reference.transitions reference) o.transitions;
    same "steps deep" (Reference.depth reference) o.depth;
    let shown = Reference.broken reference in
    let agree v =
      verdict_agrees ?start program world environment ~goes_round:(Reference.goes_round reference) shown v
      || QCheck2.Test.fail_reportf "%a" (Search.pp_verdict program) v
    in
    List.for_all agree o.verdicts

let agrees case = agrees_from case (compile case)

(* {1 From the middle of a run} *)

let is_violated = function
  | Search.Violated _ -> true
  | Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _ -> false

(* The state of the run after some of its steps, each drawn among the possible ones. *)
let rec walk environment program world ((c, e) as start) = function
  | [] -> start
  | draw :: draws -> (
      match List.of_seq (Environment.choices environment program world e c) with
      | [] -> start
      | choices ->
        let (t : Dolphin_semantics.Transition.t), e = List.nth choices (draw mod List.length choices) in
        walk environment program world (t.next, e) draws)

(* Reductions change no verdict there either, and the runs that they show are runs from there. *)
let reductions_agree start ((_, world), _, (_, environment)) program =
  let limits = { Dolphin_checker.Limits.none with max_states = Some limit } in
  let explore reduction =
    Search.run ~start { Search.default with environment; reduction; limits; search_again = 0 } program world in
  let whole = explore Reduction.Whole and reduced = explore Reduction.All in
  let agree (property, verdict) (property', verdict') =
    let is_right =
      match (verdict' : Search.verdict) with
      | Violated run -> is_run ~start program world environment run
      | Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _ -> true
    in
    property = property' && is_violated verdict = is_violated verdict' && is_right
    || QCheck2.Test.fail_reportf "reduced: %a" (Search.pp_verdict program) (property', verdict')
  in
  whole.stopped <> None || List.for_all2 agree whole.verdicts reduced.verdicts

let agrees_from_the_middle ((((_, world) as whole), looped, (name, environment)) as case, draws, lost) =
  let open Dolphin_semantics in
  let program = compile case in
  match walk environment program world (Configuration.initial program, Environment.initial) draws with
  | exception Environment.Unclear _ -> true
  | { control = Ended _; _ }, _ -> true
  | c, outside -> (
      let environment, outside = Environment.without_contact lost (environment, outside) in
      let start = (c, outside) and case = (whole, looped, (name, environment)) in
      agrees_from ~start case program
      &&
      match reductions_agree start case program with
      | agree -> agree
      | exception Environment.Unclear _ -> true)

let test_middle () =
  let lost = QCheck2.Gen.oneofl [ []; []; [ "a" ]; [ "b"; "c" ] ] in
  let case = QCheck2.Gen.(triple case (list_size (int_bound 30) (int_bound 1_000)) lost) in
  let print (case, draws, lost) =
    Printf.sprintf "after the choices %s, without contact to [%s], of %s"
      (String.concat ", " (List.map string_of_int draws)) (String.concat ", " lost) (print case)
  in
  let name = "packed and plain search agree from the middle of a run" in
  let test = QCheck2.Test.make ~count:(programs / 2) ~print ~name case agrees_from_the_middle in
  Test_support.Property.on_each_seed ~usual:20_261_127 ~programs:(programs / 2) test

let test_agreement () =
  let test = QCheck2.Test.make ~count:programs ~print ~name:"packed and plain search agree" case agrees in
  Test_support.Property.on_each_seed ~usual:20_240_817 ~programs test;
  Printf.printf "%d skipped, of more than %d states; %d unsettled\n" !skipped limit !unsettled;
  Hashtbl.iter (fun p n -> Printf.printf "%s: broken by %d\n" (Property.name p) n) broken

(* Without programs that violate it, agreement on a property means little. *)
let test_variety () =
  let enough property =
    if property <> Property.All_reached && not (Hashtbl.mem broken property) then
      Alcotest.failf "no program breaks: %s" (Property.name property)
  in
  List.iter enough Property.all

(* Files of states have no name; the system lists the open ones. *)
let test_files () =
  let descriptors = "/proc/self/fd" in
  let target name = try Unix.readlink (Filename.concat descriptors name) with Unix.Unix_error _ -> "" in
  let is_of_states path = List.mem "states" (String.split_on_char '.' (List.hd (String.split_on_char ' ' path))) in
  let targets = List.map target (Array.to_list (Sys.readdir descriptors)) in
  Alcotest.(check (list string)) "open files of states" [] (List.filter is_of_states targets)

let () =
  Alcotest.run "agreement"
    [
      ( "random programs",
        [
          Alcotest.test_case "packed and plain search agree" `Quick test_agreement;
          Alcotest.test_case "packed and plain search agree from the middle of a run" `Quick test_middle;
          Alcotest.test_case "every property is broken by some" `Quick test_variety;
          Alcotest.test_case "what was on disk is given back" `Quick test_files;
        ] );
    ]
