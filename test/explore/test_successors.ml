(* What [dolphin successors] tells of states, followed from state to state, is what the explorer finds: as many states
   and transitions, the same depth, the same verdicts, with all orders of steps and with those that partial order
   leaves. Two instances, which stand for two processes, share the states by their hashes: states are the same bytes to
   both, although each has met other things before. PROGRAMS in the environment is how many random programs are tried,
   300 by default. *)

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

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 300
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

let expanded successors states =
  match Successors.expand successors states with Ok batch -> batch | Error e -> raise (Refused e)

let note found depth (s : Successors.successor) =
  let is_known property = List.mem_assoc property found.broken in
  match s.broken with
  | Some property when not (is_known property) -> found.broken <- (property, depth) :: found.broken
  | Some _ | None -> ()

(* Some states at a time, from any of the instances. *)
let level instances found depth frontier =
  let next = ref [] in
  let number text =
    match Strings.find_opt found.numbers text with
    | Some i -> i
    | None ->
      let i = Strings.length found.numbers in
      if i >= limit then raise Too_many;
      Strings.add found.numbers text i;
      next := text :: !next;
      i
  in
  let batch i states =
    let b = expanded instances.(i) states in
    List.iter (note found (depth + 1)) b.successors;
    let targets = Array.of_list (List.map (fun (s : Successors.successor) -> number s.text) b.successors) in
    let one text (e : Successors.expansion) =
      found.transitions <- found.transitions + e.transitions;
      if e.deadlock && found.deadlock = None then found.deadlock <- Some depth;
      if List.mem true e.invariants && found.false_in = None then found.false_in <- Some depth;
      Hashtbl.replace found.edges (Strings.find found.numbers text) (List.map (Array.get targets) e.targets)
    in
    List.iter2 one states b.expansions;
    List.iter (fun pair -> Hashtbl.replace found.places pair ()) b.places;
    if b.goes_round then found.goes_round <- true;
    let still x = List.mem x b.unreached in
    found.unreached <- Some (Option.fold found.unreached ~none:b.unreached ~some:(List.filter still))
  in
  let ours i = List.filter (fun text -> Hashtbl.hash text mod Array.length instances = i) frontier in
  Array.iteri (fun i _ -> match ours i with [] -> () | states -> batch i states) instances;
  List.rev !next

let search instances =
  let found =
    { numbers = Strings.create 100; edges = Hashtbl.create 100; places = Hashtbl.create 10; transitions = 0; depth = 0;
      deadlock = None; broken = []; false_in = None; goes_round = false; unreached = None }
  in
  let first = (List.hd (expanded instances.(0) [ Successors.before ]).successors).text in
  Strings.add found.numbers first 0;
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

let check_verdict ~exact found (property, (verdict : Search.verdict)) =
  let length (run : Search.run) = if exact then Some (List.length run.steps) else None in
  let told depth = if exact then depth else None in
  let same what expected =
    match verdict, expected with
    | Holds, None -> ()
    | Violated run, Some depth when length run = told (Some depth) -> ()
    | (Holds | Violated _ | By_design _ | Unreached _ | Inconclusive _), (None | Some _) ->
      fail "%s: the explorer finds otherwise (%s)" (Property.name property) what
  in
  match (property : Property.t) with
  | No_deadlock -> same "deadlock" found.deadlock
  | No_error | Assertions | Vehicles | No_halt | No_leftover -> same "broken" (List.assoc_opt property found.broken)
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
       | Holds | Violated _ | By_design _ | Unreached _ | Inconclusive _ -> fail "termination")
  | Formula _ | Apart _ -> ()

let numbers = Alcotest.(triple int int int)

(* Whether there were few enough states to tell. *)
let agree (options : Search.options) (program : Program_file.t) world =
  let instance () = Successors.make ~greeting:"" options program world in
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
    List.iter (check_verdict ~exact:(options.reduction = Whole) found) o.verdicts;
    true

let reductions = [ Reduction.Whole; Partial_order ]

(* {1 Examples} *)

let ok = function Ok x -> x | Error e -> failwith (Format.asprintf "%a" Error.pp e)

let settle_example faults name () =
  let path = Filename.concat Examples.folder (name ^ ".dol") in
  let program = ok (Program_file.load path) and fleet = ok (Fleet_file.load_for ~program:path None) in
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

let answering = { Environment.default with answers = (fun _ -> [ [ "1"; "2" ]; [ "0" ] ]); replies = Calls.replies }

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
    { path = "random.dol"; source = ""; parameters = []; set = []; program = core; plans = lazy []; warnings = [] } in
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

let () =
  Alcotest.run "successors"
    [ ("examples", examples); ("random programs", [ Alcotest.test_case "as the explorer finds" `Quick test_random ]) ]
