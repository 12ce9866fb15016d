(* On random programs, several processes find what one finds: as many states and transitions, the same depth and
   verdicts, and runs as short; and each run that they show is one of the semantics. They start at once, however few
   states there are. PROGRAMS in the environment is how many programs are tried, 60 by default. *)

open Dolphin_explore
open Cases

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 60
let limits = { Dolphin_checker.Limits.none with max_states = Some 5_000 }
let compared = ref 0
let broken = Hashtbl.create 7

let kind (verdict : Search.verdict) =
  match verdict with
  | Holds -> "holds"
  | Holds_if _ -> "holds if"
  | By_design _ -> "by design not"
  | Violated { shortest = true; steps; cycle = [] } -> Printf.sprintf "violated after %d" (List.length steps)
  | Violated { shortest; cycle; _ } -> Printf.sprintf "violated %b %b" shortest (cycle = [])
  | Unreached pieces -> Printf.sprintf "unreached %d" (List.length pieces)
  | Inconclusive bound -> Format.asprintf "inconclusive, %a" Dolphin_checker.Limits.pp_bound bound

let text (o : Search.outcome) =
  let verdict (property, verdict) = Format.asprintf "%a: %s" Property.pp property (kind verdict) in
  Printf.sprintf "%d states, %d transitions, %d expanded, depth %d, reductions %s\n%s" o.states o.transitions o.expanded
    o.depth
    (String.concat ", " (Search.reductions o))
    (String.concat "\n" (List.map verdict o.verdicts))

let conditions = [ "!poll(x: 1)"; "count(x: _) < 2"; "!running('p')"; "!(running('p') && running('q'))" ]

let agrees (((_, world), _, (_, environment)) as case) =
  let program = compile case in
  let condition text =
    match Condition.of_string program text with Ok c -> c | Error why -> failwith (text ^ ": " ^ why) in
  let invariants = List.map condition conditions in
  let search reduction workers =
    let options = { Search.default with environment; reduction; limits; search_again = 0; invariants } in
    Search.run { options with workers; fork_from = 0; spare_bits = Some 0 } program world
  in
  let shows (property, (verdict : Search.verdict)) =
    match verdict with
    | Violated run ->
      Hashtbl.replace broken property ();
      is_run program world environment run || QCheck2.Test.fail_reportf "%a: no run" Property.pp property
    | Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _ -> true
  in
  let same reduction =
    let alone = search reduction 1 in
    let is_same workers =
      let together = search reduction workers in
      (text alone = text together
       || QCheck2.Test.fail_reportf "%s:\n1 worker: %s\n%d workers: %s" (String.concat "+" (Reduction.names reduction)) (text alone) workers
         (text together))
      && List.for_all shows together.verdicts
    in
    if alone.stopped = None then begin
      incr compared;
      is_same 2 && is_same 3
    end
    else true
  in
  List.for_all same [ Reduction.Whole; All ]

let test_agreement () =
  let test = QCheck2.Test.make ~count:programs ~print ~name:"one process and several agree" case agrees in
  Test_support.Property.on_each_seed ~usual:20_261_125 ~programs test;
  Printf.printf "%d compared\n" !compared;
  Hashtbl.iter (fun p () -> Printf.printf "broken by some: %s\n" (Property.name p)) broken

let () =
  Alcotest.run "workers"
    [ ("random programs", [ Alcotest.test_case "one process and several agree" `Quick test_agreement ]) ]
