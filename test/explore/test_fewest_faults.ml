(* Each violation is shown by a run with the fewest faults. On random programs with random faults, a violation of the
   program without faults is shown by a run without one. Of the others, the number of faults and the length of the run
   are those of plain searches with that number in all, in each way to divide it among failures, losses and late
   vehicles; and no search with one fault less finds the violation. PROGRAMS in the environment is how many programs are
   tried, 300 by default. *)

open Dolphin_environment
open Dolphin_explore
open Cases

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 300
let limit = 2_000

(* By the number of faults of their runs, how many violations were shown; and how many of them at first by another run,
   as one with more faults was shorter. *)
let shown = Hashtbl.create 3
let longer = ref 0
let note table n = if Test_support.Property.is_usual () then
    Hashtbl.replace table n (1 + Option.value (Hashtbl.find_opt table n) ~default:0)

let faults =
  let open QCheck2.Gen in
  let limit = oneofl [ Faults.Never; At_most 1; At_most 2; Any_number; Any_number ] in
  let* fail = limit and* loss = limit and* join = limit in
  return { Faults.none with fail; loss; join }

(* With plans that [a] may fail by itself, or without. *)
let case =
  let open QCheck2.Gen in
  let* (whole, looped, (_, environment)) = Cases.case
  and* faults = faults
  and* may_fail = frequencyl [ (3, false); (1, true) ] in
  let endings v _ = if may_fail && String.equal v "a" then Environment.May_fail else Succeeds in
  let environment = { environment with faults; endings } in
  let* reduction = oneofl [ Reduction.Whole; All ] in
  return ((whole, looped, (Format.asprintf "%a" Faults.pp faults, environment)), reduction, may_fail)

let without_faults environment = fst (Environment.without_faults (environment, Environment.initial))

let with_at_most environment = function
  | 0 -> without_faults environment
  | n -> { environment with Environment.most_faults = Some n }

(* The environments with [n] faults in which each kind has a limit of its own. *)
let apart environment n =
  let up_to : Faults.limit -> int list = function
    | Never -> [ 0 ]
    | At_most most -> List.init (1 + min most n) Fun.id
    | Any_number -> List.init (1 + n) Fun.id
  in
  let { Faults.fail; loss; join; _ } = environment.Environment.faults in
  let at_most = function 0 -> Faults.Never | n -> At_most n in
  let with_ f l j =
    if f + l + j <> n then None
    else Some { environment with faults = { Faults.none with fail = at_most f; loss = at_most l; join = at_most j } }
  in
  let of_failures f = List.concat_map (fun l -> List.filter_map (with_ f l) (up_to join)) (up_to loss) in
  List.concat_map of_failures (up_to fail)

(* The steps of a shortest run that breaks [property] in one of these environments; nothing if that is not known. *)
let least program world property environments =
  let of_environment environment =
    match Reference.explore ~limit environment program world with
    | None -> None
    | Some reference when property = Property.Termination && Reference.goes_round reference -> None
    | Some reference -> Some (List.assoc_opt property (Reference.broken reference))
  in
  let add found environment =
    match found, of_environment environment with
    | None, _ | _, None -> None
    | Some None, Some n | Some n, Some None -> Some n
    | Some (Some m), Some (Some n) -> Some (Some (min m n))
  in
  List.fold_left add (Some None) environments

let looks (program : Dolphin_semantics.Core.program) = program.reads_sensors || program.reads_now
let fail format = QCheck2.Test.fail_reportf format

let check ~may_fail environment program world property (run : Search.run) =
  match run.faults with
  | None when property = Property.Termination && program.Dolphin_semantics.Core.recruits -> ()
  | None -> fail "%a: faults are not counted" Property.pp property
  | Some { fewest = false; _ } -> fail "%a: perhaps not the fewest" Property.pp property
  | Some { number; fewest = true } ->
    note shown number;
    (* Failures of plans that may fail by themselves count for the limit of failures. *)
    let allowing n = if may_fail || n = 0 then [ with_at_most environment n ] else apart environment n in
    let least n = least program world property (allowing n) in
    (match if number = 0 then Some None else least (number - 1) with
     | Some (Some _) -> fail "%a: %d faults, but fewer are enough" Property.pp property number
     | Some None | None -> ());
    (* A cycle with a fault takes one in each round. *)
    (match if property = Termination then None else least number with
     | Some None -> fail "%a: not violated by %d faults" Property.pp property number
     (* The reference counts runs whose looks at sensors contradict each other, which no world has. *)
     | Some (Some n) when looks program && n < List.length run.steps -> ()
     | Some (Some n) when run.shortest && n <> List.length run.steps ->
       fail "%a: %d steps, %d expected" Property.pp property (List.length run.steps) n
     | Some (Some _) | None -> ());
    let once_around = { run with steps = run.steps @ run.cycle; cycle = [] } in
    if not (is_run program world (with_at_most environment number) once_around) then
      fail "%a: not a run with %d faults" Property.pp property number

let agrees (((((_, world), _, (_, environment)) as case), reduction, may_fail)) =
  let program = compile case in
  let explore environment = Search.run { Search.default with environment; reduction } program world in
  match Reference.explore ~limit environment program world with
  | None | (exception Environment.Unclear _) -> true
  | Some _ ->
    let first = explore environment and none = explore (without_faults environment) in
    let found = Fewest_faults.run { Search.default with environment; reduction } program world in
    let run (o : Search.outcome) property =
      match List.assoc property o.verdicts with
      | Violated run -> Some run
      | Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _ -> None
    in
    let judge property =
      match run none property, run first property, run found property with
      | Some _, _, (None | Some { faults = None; _ }) ->
        fail "%a: violated without faults, but that is not shown" Property.pp property
      | Some _, _, Some { faults = Some { number; _ }; _ } when number > 0 ->
        fail "%a: violated without faults, and shown with %d" Property.pp property number
      | _, Some _, None | _, None, Some _ -> fail "%a: another verdict" Property.pp property
      | _, None, None -> ()
      | _, Some before, Some run ->
        if List.compare_lengths before.steps run.steps < 0 then Test_support.Property.count longer;
        check ~may_fail environment program world property run
    in
    if Faults.(environment.faults <> none) then List.iter judge Property.all;
    true

let test () =
  let print (case, reduction, may_fail) =
    Printf.sprintf "%s\nreduced by [%s]%s" (Cases.print case) (String.concat ", " (Reduction.names reduction))
      (if may_fail then "; plans may fail on a" else "")
  in
  let test = QCheck2.Test.make ~count:programs ~print ~name:"runs with the fewest faults" case agrees in
  Test_support.Property.on_each_seed ~usual:20_271_127 ~programs test

(* Without such programs the test means little. *)
let test_variety () =
  let count n = Option.value (Hashtbl.find_opt shown n) ~default:0 in
  Printf.printf "violations by faults: 0: %d, 1: %d, 2: %d; %d had a shorter run with more\n" (count 0) (count 1)
    (count 2) !longer;
  List.iter (fun n -> Alcotest.(check bool) (Printf.sprintf "%d faults" n) true (count n > 0)) [ 0; 1; 2 ];
  Alcotest.(check bool) "a shorter run has more" true (!longer > 0)

let () =
  Alcotest.run "fewest faults"
    [ ( "random programs",
        [ Alcotest.test_case "runs with the fewest faults" `Quick test;
          Alcotest.test_case "as many as can be" `Quick test_variety ] ) ]
