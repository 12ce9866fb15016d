open Dolphin_tlc
open Dolphin_lts
module Reference = Dolphin_explore.Reference

(* What TLC counts must be what was printed: one line for each state, and one for each transition. *)
let is_complete printed (o : Outcome.t) =
  o.queue = 0 && o.distinct = Printed_graph.states printed && o.generated = 1 + Printed_graph.transitions printed

let graph_of_tlc installation ~directory ~configuration =
  let printed = Printed_graph.create () in
  let problem = ref None in
  let take text =
    match !problem, Printed_graph.line printed text with
    | None, Error p -> problem := Some p
    | None, Ok (true | false) | Some _, _ -> ()
  in
  let mode = Invocation.Local (Workers 1) in
  match Tlc_session.run installation mode ~directory ~configuration ~coverage:false take with
  | Error status -> Error status
  | Ok (Interrupted _) -> Report.complain "interrupted before TLC was done"; Error Exit_status.Inconclusive
  | Ok (Ended outcome) -> (
      match !problem, Printed_graph.graphs printed with
      | None, Ok [ (_, graph) ] when is_complete printed outcome -> Ok graph
      | None, Ok _ ->
        Report.complain
          (Printf.sprintf "TLC counts %d states and %d transitions, but its model printed %d and %d" outcome.distinct
             (outcome.generated - 1) (Printed_graph.states printed) (Printed_graph.transitions printed));
        Error Exit_status.Inconclusive
      | Some problem, _ | None, Error problem ->
        Report.complain (Format.asprintf "the graph that TLC printed cannot be read: %a" Printed_graph.pp_problem problem);
        Error Exit_status.Inconclusive)

let judge ours theirs =
  match Compare.isomorphic ours theirs with
  | Ok () ->
    Printf.printf "isomorphic, with equal labels and derivations: %d states, %d transitions\n" (Graph.states ours)
      (Graph.transitions ours);
    Exit_status.Done
  | Error difference ->
    Format.printf "not isomorphic; left is the explorer's graph, right TLC's@.%a@." Isomorphism.pp_difference difference;
    (match difference.reason with Undecided -> Inconclusive | _ -> Violated)

let run installation ~directory ~limit ~configuration model options (program : Program_file.t) world =
  match Reference.explore ~limit options program.program world with
  | None ->
    Report.complain (Printf.sprintf "%s has more than %d states: see --max-states" program.path limit);
    Exit_status.Inconclusive
  | Some space -> (
      Tlc_session.in_directory directory model @@ fun directory ->
      match graph_of_tlc installation ~directory ~configuration with
      | Error status -> status
      | Ok theirs -> judge (Explored.graph space) theirs)
