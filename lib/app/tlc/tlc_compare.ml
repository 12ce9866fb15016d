open Dolphin_tlc
open Dolphin_lts
module Safe_print = Dolphin_display.Safe_print
module Run = Dolphin_tla.Tlc_questions
module Reference = Dolphin_explore.Reference

(* TLC's counts must equal the printed ones: one line for each state, and one for each transition. *)
let is_complete printed (o : Outcome.t) =
  o.queue = 0 && o.distinct = Printed_graph.states printed && o.generated = 1 + Printed_graph.transitions printed

let inconclusive format = Printf.ksprintf (fun why -> Error (Error.Inconclusive why)) format

let graph_of_tlc installation ~directory =
  let printed = Printed_graph.create () in
  let problem = ref None in
  let take text =
    match !problem, Printed_graph.line printed text with
    | None, Error p -> problem := Some p
    | None, Ok (true | false) | Some _, _ -> ()
  in
  let mode = Invocation.Local (Workers 1) in
  match Tlc_session.run installation mode ~directory ~main:Run.main ~configuration:Run.graph take with
  | Error _ as error -> error
  | Ok (Interrupted _) -> inconclusive "interrupted before TLC was done"
  | Ok (Ended outcome) -> (
      match !problem, Printed_graph.graphs printed with
      | None, Ok [ (_, graph) ] when is_complete printed outcome -> Ok (graph, Printed_graph.used printed)
      | None, Ok _ ->
        inconclusive "TLC counts %d states and %d transitions, but its model printed %d and %d" outcome.distinct
          (outcome.generated - 1) (Printed_graph.states printed) (Printed_graph.transitions printed)
      | Some problem, _ | None, Error problem ->
        inconclusive "the graph that TLC printed cannot be read: %s"
          (Format.asprintf "%a" Printed_graph.pp_problem problem))

(* Beside its transitions a graph has what is seen of each state, as transitions from it to itself. *)
let judge space theirs : Exploration.verdict =
  match Compare.isomorphic (Explored.graph space) theirs with
  | Ok () ->
    Safe_print.printf "isomorphic, with equal labels and derivations, and equal A, B and N: %d states, %d transitions\n"
      (Array.length space.states) (Reference.transitions space);
    Holds
  | Error difference ->
    Safe_print.format
      "not isomorphic. Left is the explorer's graph, right TLC's; the observable part of a state counts as a \
       transition that stays there, in parentheses.@.%a@."
      Isomorphism.pp_difference difference;
    (match difference.reason with
     | Undecided -> Inconclusive
     | Enabled _ | Merged _ | Unmatched _ | No_matching -> Violated)

(* Rules in the order of the semantics. *)
let print_coverage used =
  let print rule =
    let name = Dolphin_semantics.Rule.name rule in
    if used name > 0 then Safe_print.printf "%-16s %d\n" name (used name)
  in
  List.iter print Dolphin_semantics.Rule.all

let ( let* ) = Result.bind

let run installation ~directory ~limit ~coverage model options (program : Program_file.t) world =
  let* space = Exported_graph.explored ~limit options program world in
  let files = List.map (fun (f : Dolphin_tla.Model.file) -> (f.name, f.text)) (Run.files ~strict:false model) in
  Tlc_session.in_directory directory files @@ fun directory ->
  let* theirs, used = graph_of_tlc installation ~directory in
  let verdict = judge space theirs in
  if coverage then print_coverage used;
  Ok verdict
