open Dolphin_semantics
open Dolphin_lts
module Reference = Dolphin_explore.Reference

let ending (c : Configuration.t) =
  match c.control with
  | Ended Completed -> if Tuples.is_empty c.tuples then "completed" else "completed, with tuples left"
  | Ended (Halted message) -> "halted: " ^ message
  | Ended (Failed fault) -> "failed: " ^ fault.message
  | Ended Interrupted -> "interrupted"
  | Script _ | Waiting _ | Executing _ -> ""

let label (t : Transition.t) =
  let rules = String.concat ", " (List.map Rule.name t.rules) in
  Printed_graph.label ~rules (Format.asprintf "%a" Label.pp t.label)

let graph (space : Reference.t) =
  let b = Graph.Builder.create () in
  let state s (edges : (Transition.t * int) list) =
    List.iter (fun (t, target) -> Graph.Builder.add b s (label t) target) edges;
    match ending space.states.(s).configuration with
    | "" -> ()
    | ending -> Graph.Builder.add b s (Printed_graph.ending_label ending) s
  in
  Array.iteri state space.edges;
  Graph.Builder.finish ~states:(Array.length space.states) b
