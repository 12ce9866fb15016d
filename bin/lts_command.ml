open Cmdliner
open Dolphin_lts
module Reference = Dolphin_explore.Reference
module Scenario_world = Dolphin_environment.Scenario_world

type format = Aut | Dot | Json
type equivalence = Strong

let ( let* ) = Result.bind

(* {1 Graphs} *)

let graph_of_program path fleet ~answers ~faults ~limit =
  match Program_file.load path, Fleet_file.load (Fleet_file.choose ~program:path fleet) with
  | Error trouble, _ -> Program_file.tell trouble; Error Exit_status.Bad_input
  | Ok _, Error trouble -> Fleet_file.tell trouble; Error Exit_status.Bad_input
  | Ok program, Ok fleet -> (
      let environment = Scenario_world.environment ~answers ~faults fleet.scenario in
      match Reference.explore ~limit environment program.program (Scenario_world.world fleet.scenario) with
      | None ->
        Report.complain (Printf.sprintf "%s has more than %d states: see --max-states" path limit);
        Error Exit_status.Inconclusive
      | exception Dolphin_semantics.Reading.Unsettled fault ->
        Program_file.tell_fault program fault;
        Error Exit_status.Inconclusive
      | Some space ->
        let builder = Graph.Builder.create () in
        let add from (t, target) =
          let label = Format.asprintf "%a" Dolphin_semantics.Label.pp t.Dolphin_semantics.Transition.label in
          Graph.Builder.add builder from label target
        in
        Array.iteri (fun from edges -> List.iter (add from) edges) space.edges;
        let text s =
          Format.asprintf "%a" (Dolphin_semantics.Configuration.pp program.program) space.states.(s).configuration
        in
        Ok (Graph.Builder.finish ~states:(Array.length space.states) ~text builder))

let wrong path why =
  Report.complain (Printf.sprintf "%s: %s" path why);
  Error Exit_status.Bad_input

let graph_of_file path ~of_program =
  let parsed pp = function Ok graph -> Ok graph | Error e -> wrong path (Format.asprintf "%a" pp e) in
  let text read =
    match Text_file.read path with
    | Ok text -> read text
    | Error why -> Report.complain why; Error Exit_status.Bad_input
  in
  match Filename.extension path with
  | ".aut" -> text (fun text -> parsed Aldebaran.pp_error (Aldebaran.of_string text))
  | ".json" -> text (fun text -> parsed Json.pp_error (Json.of_string text))
  | _ -> of_program path

(* {1 Results} *)

let write format output graph =
  let to_channel channel =
    let sink = output_string channel in
    match format with
    | Aut -> Aldebaran.write sink graph
    | Dot -> Graphviz.write sink graph
    | Json -> Dolphin_lts.Json.write sink graph
  in
  match output with
  | None -> to_channel stdout; Exit_status.Done
  | Some path -> (
      match open_out_bin path with
      | exception Sys_error why -> Report.complain why; Exit_status.Platform_trouble
      | channel ->
        Fun.protect ~finally:(fun () -> close_out channel) (fun () -> to_channel channel);
        Exit_status.Done)

let compare_graphs left right =
  match Compare.strong left right with
  | Ok () -> print_endline "strongly bisimilar"; Exit_status.Done
  | Error difference ->
    Format.printf "not bisimilar@.%a@." Compare.pp_difference difference;
    Exit_status.Violated

let run path other fleet answers faults limit format quotient output =
  let of_program path = graph_of_program path fleet ~answers ~faults ~limit in
  let result =
    let* graph = graph_of_file path ~of_program in
    match other with
    | Some other ->
      let* other = graph_of_file other ~of_program in
      Ok (compare_graphs graph other)
    | None -> Ok (write format output (match quotient with Some Strong -> Partition.minimal graph | None -> graph))
  in
  match result with Ok status | Error status -> status

(* {1 The command} *)

let graph =
  let doc = "A program, or a graph in a file that ends in $(b,.aut) or $(b,.json)." in
  Arg.(required & pos 0 (some string) None & info [] ~docv:"PROG" ~doc)

let compare_with =
  let doc =
    "Compare with the graph of $(docv), a program or a file as above: say whether they are strongly bisimilar, or else \
     what only one of them can do."
  in
  Arg.(value & opt (some string) None & info [ "compare" ] ~docv:"OTHER" ~doc)

let format =
  let formats = [ ("aut", Aut); ("dot", Dot); ("json", Json) ] in
  let doc =
    "How to write the graph: $(b,aut), the Aldebaran format of CADP, mCRL2 and LTSmin; $(b,dot), for Graphviz; or \
     $(b,json)."
  in
  Arg.(value & opt (enum formats) Aut & info [ "format" ] ~docv:"FORMAT" ~doc)

let quotient =
  let doc = "Write the smallest graph that is bisimilar: $(b,strong)." in
  let kinds = [ ("strong", Strong) ] in
  Arg.(value & opt (some (enum kinds)) None & info [ "quotient" ] ~docv:"KIND" ~doc)

let output =
  let doc = "Write to $(docv) instead of standard output." in
  Arg.(value & opt (some string) None & info [ "o"; "output" ] ~docv:"FILE" ~doc)

let limit =
  let doc = "Give up after $(docv) states." in
  Arg.(value & opt int 1_000_000 & info [ "max-states" ] ~docv:"N" ~doc)

let man =
  [ `S Manpage.s_description;
    `P "$(tname) writes the labelled transition system of a program in its world: its states are the configurations, \
        its transitions carry the labels of $(i,docs/semantics.md). The world is that of $(mname) $(b,explore).";
    `P "With $(b,--compare) it tells two such graphs apart, by a formula that only one of them fulfils and, where \
        there is one, a run that only one of them has.";
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname) examples/parallel.dol -o parallel.aut\n\
         \  $(mname) $(tname) examples/parallel.dol --quotient strong --format dot | dot -Tsvg > parallel.svg\n\
         \  $(mname) $(tname) examples/parallel.dol --compare parallel.aut" ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "lts" ~doc:"write the state graph of a program, or compare graphs" ~man
      ~exits:(Options.exits [ Done; Violated; Bad_input; Inconclusive; Bug ])
  in
  Cmd.v info
    Term.(
      const run $ graph $ compare_with $ Options.fleet $ Explore_command.answers $ Explore_command.faults $ limit
      $ format
      $ quotient $ output)
