(* The output of [dolphin successors], followed from state to state, is the explorer's result: as many states and
   transitions, the same depth, the same verdicts, with all orders of steps and with those that partial order leaves.
   Two instances, which stand for two processes, share the states by their digests: states are the same bytes to
   both, although each has met other states before; each gets the parts that the other sent. PROGRAMS in the
   environment is how many random programs are tried, 150 by default. *)

open Dolphin_environment
open Dolphin_explore
open Dolphin_app
module Generate = Test_support.Generate
module Examples = Test_support.Examples
module Posts = Test_support.Posts
module Calls = Test_support.Calls
module Strings = Hashtbl.Make (struct
    type t = string

    let equal = String.equal
    let hash = Hashtbl.hash
  end)

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 150
let limit = 3_000

(* {1 A search} *)

type found = {
  numbers : int Strings.t;
  edges : (int, int list) Hashtbl.t;
  places : (string * string, unit) Hashtbl.t;
  mutable transitions : int;
  mutable depth : int;
  mutable deadlock : int option;  (* how many transitions lead there, at least; so are these *)
  mutable broken : (Property.t * int) list;
  mutable false_in : int option;  (* the first invariant *)
  mutable goes_round : bool;
  mutable unreached : string list option;
}

exception Too_many
exception Refused of Error.t

let settled = function Ok x -> x | Error e -> raise (Refused e)

(* The output of one instance on states, in as many blocks as there are instances. The others are given its parts. *)
let expanded instances i states =
  let partitions = Array.length instances in
  let batch = settled (Successor_service.expand instances.(i) ~partitions ~targets:true states) in
  Array.iteri (fun j other -> if j <> i then settled (Successor_service.give other batch.parts)) instances;
  batch

let reached (b : Successor_service.batch) = List.concat_map State_columns.states (Array.to_list b.blocks)

(* The violations, with a state of the batch or a successor. *)
let note found depth (b : Successor_service.batch) sources =
  let states = reached b in
  let one ((breach : Successor_service.breach), digest) =
    match breach with
    | Breaks No_deadlock ->
      assert (List.mem digest sources);
      if found.deadlock = None then found.deadlock <- Some depth
    | Makes_false _ ->
      assert (List.mem digest sources);
      if found.false_in = None then found.false_in <- Some depth
    | Breaks property ->
      let breaks (s : State_columns.state) = s.kind land 127 = Successor_service.kind ~is_end:false (Some property) in
      let others = List.map (fun (s : State_columns.state) -> s.digest) (List.filter breaks states) in
      Alcotest.(check string) "the least of them" (List.fold_left min (List.hd others) others) digest;
      if not (List.mem_assoc property found.broken) then found.broken <- (property, depth + 1) :: found.broken
  in
  List.iter one b.broken

(* The columns of states beside their texts. *)
let check_states partitions sources (b : Successor_service.batch) =
  let parents = Hashtbl.create 16 in
  let leads source place = if not (Hashtbl.mem parents place) then Hashtbl.add parents place (String.sub source 0 8) in
  List.iter2 (fun source places -> List.iter (leads source) places) sources (Array.to_list b.targets);
  let one partition place (s : State_columns.state) =
    Alcotest.(check string) "the digest of the text" (Digest.to_hex (Digest.string s.text)) (Digest.to_hex s.digest);
    Alcotest.(check int) "where its digest says" (Successor_service.partition ~partitions s.digest) partition;
    Alcotest.(check string) "the first that leads there" (Hashtbl.find parents place) s.parent
  in
  let block (first, partition) states =
    List.iteri (fun i -> one partition (first + i)) states;
    (first + List.length states, partition + 1)
  in
  ignore (List.fold_left block (0, 0) (List.map State_columns.states (Array.to_list b.blocks)))

(* Some states at a time, each by the instance of its partition. *)
let level instances found depth frontier =
  let next = ref [] in
  let number (s : State_columns.state) =
    match Strings.find_opt found.numbers s.text with
    | Some i -> i
    | None ->
      let i = Strings.length found.numbers in
      if i >= limit then raise Too_many;
      Strings.add found.numbers s.text i;
      next := s :: !next;
      i
  in
  let batch i (states : State_columns.state list) =
    let sources = List.map (fun (s : State_columns.state) -> s.digest) states in
    let source (s : State_columns.state) : Successor_service.source =
      { text = s.text; is_end = Successor_service.is_end s.kind } in
    let b = expanded instances i (List.map source states) in
    note found depth b sources;
    let texts = List.map (fun (s : State_columns.state) -> s.text) (reached b) in
    Alcotest.(check int) "each once" (List.length texts) (List.length (List.sort_uniq String.compare texts));
    check_states (Array.length instances) sources b;
    let targets = Array.of_list (List.map number (reached b)) in
    found.transitions <- found.transitions + b.transitions;
    let one (s : State_columns.state) places =
      Hashtbl.replace found.edges (Strings.find found.numbers s.text) (List.map (Array.get targets) places) in
    List.iter2 one states (Array.to_list b.targets);
    List.iter (fun pair -> Hashtbl.replace found.places pair ()) b.places;
    if b.goes_round then found.goes_round <- true;
    let still x = List.mem x b.unreached in
    found.unreached <- Some (Option.fold found.unreached ~none:b.unreached ~some:(List.filter still))
  in
  let partitions = Array.length instances in
  let is_of i (s : State_columns.state) = Successor_service.partition ~partitions s.digest = i in
  Array.iteri (fun i _ -> match List.filter (is_of i) frontier with [] -> () | states -> batch i states) instances;
  List.rev !next

let search instances =
  let found =
    { numbers = Strings.create 100; edges = Hashtbl.create 100; places = Hashtbl.create 10; transitions = 0; depth = 0;
      deadlock = None; broken = []; false_in = None; goes_round = false; unreached = None }
  in
  let first = List.hd (reached (expanded instances 0 [ Successor_service.before ])) in
  Strings.add found.numbers first.text 0;
  let rec go depth = function
    | [] -> ()
    | frontier ->
      found.depth <- depth;
      go (depth + 1) (level instances found depth frontier)
  in
  go 0 [ first ];
  found

(* Whether anything is left once what leads nowhere is taken away, again and again. *)
let is_cyclic nodes following =
  let rec prune left =
    let stays x = List.exists (fun y -> List.mem y left) (following x) in
    let rest = List.filter stays left in
    if List.compare_lengths rest left = 0 then left <> [] else prune rest
  in
  prune nodes

let places_are_cyclic found =
  let pairs = Hashtbl.fold (fun pair () all -> pair :: all) found.places [] in
  let nodes = List.sort_uniq compare (List.concat_map (fun (a, b) -> [ a; b ]) pairs) in
  is_cyclic nodes (fun x -> List.filter_map (fun (a, b) -> if a = x then Some b else None) pairs)

let graph_is_cyclic found =
  let following = Array.init (Strings.length found.numbers) (Hashtbl.find found.edges) in
  let before = Array.make (Array.length following) [] and left = Array.map List.length following in
  Array.iteri (fun i js -> List.iter (fun j -> before.(j) <- i :: before.(j)) js) following;
  let removed = ref 0 in
  let rec remove i =
    incr removed;
    List.iter (fun h -> left.(h) <- left.(h) - 1; if left.(h) = 0 then remove h) before.(i)
  in
  let ends = List.filter (fun i -> following.(i) = []) (List.init (Array.length following) Fun.id) in
  List.iter remove ends;
  !removed < Array.length following

(* {1 Agreement} *)

let fail format = Format.kasprintf failwith format

(* The graph has runs whose looks at sensors and dates contradict each other, which no world has: where a program
   [looks], the explorer may show a longer run, or none. *)
let check_verdict ~exact ~looks ~only_in_worlds found (property, (verdict : Search.verdict)) =
  let length (run : Search.run) = if exact then Some (List.length run.steps) else None in
  let told depth = if exact then depth else None in
  let same what expected =
    match verdict, expected with
    | Holds, None -> ()
    | Violated run, Some depth when length run = told (Some depth) -> ()
    | Violated run, Some depth when looks && List.length run.steps > depth -> ()
    | Holds, Some _ when List.mem property only_in_worlds -> ()
    | Inconclusive (Unsettled _), Some _ when looks -> ()
    | (Holds | Holds_if _ | Violated _ | By_design _ | Unreached _ | Inconclusive _), (None | Some _) ->
      fail "%s: the explorer finds otherwise (%s)" (Property.name property) what
  in
  match (property : Property.t) with
  | No_deadlock -> same "deadlock" found.deadlock
  | No_error | Assertions | Vehicles | Allocation | No_halt | No_leftover -> same "broken" (List.assoc_opt property found.broken)
  | Invariant _ -> same "invariant" found.false_in
  | All_reached -> (
      match verdict, found.unreached with
      | Holds, Some [] -> ()
      | Unreached pieces, Some left when List.compare_lengths pieces left = 0 -> ()
      | _, _ -> fail "other pieces are unreached")
  | Termination ->
    let is_cyclic = graph_is_cyclic found in
    if is_cyclic && not (found.goes_round || places_are_cyclic found) then fail "a cycle without a cycle of places";
    if not found.goes_round then
      (match verdict with
       | Holds when not is_cyclic -> ()
       | Violated _ when is_cyclic -> ()
       | Holds | Holds_if _ | Violated _ | By_design _ | Unreached _ | Inconclusive _ -> fail "termination")
  | Formula _ | Apart _ -> ()

let numbers = Alcotest.(triple int int int)

(* Whether the states are few enough to decide. *)
let agree (options : Search.options) (program : Program_file.t) world =
  let instance () = Successor_service.make ~greeting:"" options program world in
  match search [| instance (); instance () |] with
  | exception Too_many -> false
  | exception Refused (Inconclusive _) ->
    (match (Search.run options program.program world).stopped with
     | Some (Unsettled _) -> true
     | Some _ | None -> fail "nobody can tell what follows, but the explorer can")
  | found ->
    let o = Search.run options program.program world in
    Alcotest.check numbers "states, transitions, depth" (o.states, o.transitions, o.depth)
      (Strings.length found.numbers, found.transitions, found.depth);
    let looks = program.program.reads_sensors || program.program.reads_now in
    let exact = options.reduction = Whole in
    List.iter (check_verdict ~exact ~looks ~only_in_worlds:o.only_in_worlds found) o.verdicts;
    true

let reductions = [ Reduction.Whole; Partial_order ]

(* {1 Examples} *)

let ok = function Ok x -> x | Error e -> failwith (Format.asprintf "%a" Error.pp e)

let settle_example faults name () =
  let path = Filename.concat Examples.folder (name ^ ".dol") in
  let program, fleet = ok (Program_file.load_with_fleet ~set:[] ~fleet:None path) in
  let program = ok (Program_file.within fleet program) in
  let environment = Scenario_world.environment ~answers:[] ~faults program.program fleet.scenario in
  let world = Scenario_world.world fleet.scenario in
  let with_ reduction = ignore (agree { Search.default with environment; reduction } program world : bool) in
  List.iter with_ reductions

let faults = [ ("", Faults.none); (" with faults", Result.get_ok (Faults.of_string "fail=1,loss=1,join=1")) ]

let examples =
  let case name (what, faults) = Alcotest.test_case (name ^ what) `Quick (settle_example faults name) in
  List.concat_map (fun name -> List.map (case name) faults) (Examples.names ())

(* {1 Random programs} *)

let answering = Calls.answering

let environments =
  [ ("as planned", answering);
    ("with a failure", Environment.failing ~failures:1 answering);
    ( "with all of it, once",
      { answering with faults = { Faults.none with fail = At_most 1; loss = At_most 1; join = At_most 1 } } );
    ("with inputs", { answering with inputs = Posts.inputs });
    ("with interruptions", { answering with faults = { Faults.none with interrupt = true } }) ]

let nested ~sensing =
  let nested = if sensing then Generate.sensing_nested else Generate.nested in
  let before = if sensing then [ Generate.kept ] else [ Generate.statement (Generate.post "x" 1) ] in
  QCheck2.Gen.(
    let* depth = int_range 0 2 in
    map (Generate.executing ~before) (nested ~vehicles:Generate.vehicles ~depth))

let case =
  let open QCheck2.Gen in
  let closed p = (p, Generate.world) and opened p = (p, Generate.open_world) in
  let program =
    frequency
      [ (3, map closed Generate.program); (3, map closed (Calls.within Generate.program));
        (3, map closed (nested ~sensing:false)); (1, map opened Generate.sensing_program);
        (1, map opened (nested ~sensing:true)) ]
  in
  quad program (frequencyl [ (3, false); (1, true) ]) (oneofl environments) (oneofl reductions)

let print ((program, _), looped, (name, _), reduction) =
  Printf.sprintf "%s%s%s:\n%s" name
    (if looped then ", for ever" else "")
    (if Reduction.by_order reduction then ", reduced" else "")
    (Generate.print program)

let told = ref 0

let agrees ((ast, world), looped, (_, environment), reduction) =
  let core = Posts.declared environment (Generate.compile (if looped then Generate.for_ever ast else ast)) in
  let program : Program_file.t =
    { path = "random.dol"; source = ""; parameters = []; set = []; program = core; ast = []; without_place = lazy [];
      plans = (fun ~place:_ -> []); warnings = [] } in
  let invariants =
    if Reduction.by_order reduction then []
    else match Condition.of_string core "!poll(x: 1)" with Ok condition -> [ condition ] | Error why -> failwith why
  in
  if agree { Search.default with environment; reduction; invariants } program world then incr told;
  true

let test_random () =
  let test = QCheck2.Test.make ~count:programs ~print ~name:"as the explorer finds" case agrees in
  Test_support.Property.on_each_seed ~usual:20_261_123 ~programs test;
  Printf.printf "%d told, of at most %d states\n" !told limit

(* {1 Parts} *)

let rendezvous () =
  let path = Filename.concat Examples.folder "rendezvous.dol" in
  let program, fleet = ok (Program_file.load_with_fleet ~set:[] ~fleet:None path) in
  let environment = Scenario_world.environment ~answers:[] ~faults:Faults.none program.program fleet.scenario in
  (program, { Search.default with environment }, Scenario_world.world fleet.scenario)

(* The first states in which a task executes, and the parts sent until then. *)
let rec executing successors parts sources =
  let batch = settled (Successor_service.expand successors sources) in
  let states = reached batch and parts = parts @ batch.parts in
  if List.exists (fun (s : State_columns.state) -> s.text.[0] = 'e') states then (states, parts)
  else executing successors parts (List.map (fun (s : State_columns.state) : Successor_service.source ->
      { text = s.text; is_end = false }) states)

let test_parts () =
  let program, options, world = rendezvous () in
  let instance () = Successor_service.make ~greeting:"" options program world in
  let states, parts = executing (instance ()) [] [ Successor_service.before ] in
  let state = List.find (fun (s : State_columns.state) -> s.text.[0] = 'e') states in
  let source : Successor_service.source = { text = state.text; is_end = false } in
  let answer given =
    let other = instance () in
    settled (Successor_service.give other given);
    match Successor_service.expand other [ source ] with
    | Ok batch -> Printf.sprintf "%d transitions, %d parts" batch.transitions (List.length batch.parts)
    | Error e -> Format.asprintf "%a" Error.pp e
  in
  let unknown = "state 1 of the batch is not a state of this program: it names a part that was not given" in
  Alcotest.(check string) "without parts" unknown (answer []);
  List.iteri
    (fun i _ ->
       let others = List.filteri (fun j _ -> j <> i) parts in
       Alcotest.(check string) "without one of them" unknown (answer others))
    parts;
  let all = answer parts in
  Alcotest.(check bool) all true (Scanf.sscanf all "%d transitions, %d parts%!" (fun n _ -> n > 0));
  (* Sent once, at the first use. *)
  let again = instance () in
  settled (Successor_service.give again parts);
  let told () = List.length (settled (Successor_service.expand again [ source ])).parts in
  let first = told () in
  Alcotest.(check (pair bool int)) "told once" (true, 0) (first > 0, told ())

let test_ambiguous () =
  let program, options, world = rendezvous () in
  let space = Search.space options program.program world in
  let part () : _ Portable.part = { write = (fun _ -> ""); read = (fun _ -> raise (Portable.Wrong "")) } in
  let codec : Portable.codec = { machine = part (); residual = part (); shared = part (); configuration = part () } in
  let texts = Space.portable ~digest:(fun text -> String.make 8 text.[0]) codec space in
  List.iter (Space.give texts) [ "a"; "b"; "a" ];
  Alcotest.check_raises "another text of the same digest" Portable.Ambiguous (fun () -> Space.give texts "bc")

let () =
  Alcotest.run "successors"
    [ ("examples", examples);
      ( "parts",
        [ Alcotest.test_case "are given" `Quick test_parts;
          Alcotest.test_case "of one name" `Quick test_ambiguous ] );
      ("random programs", [ Alcotest.test_case "as the explorer finds" `Quick test_random ]) ]
