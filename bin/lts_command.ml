open Cmdliner
open Dolphin_app
open Dolphin_lts
module Safe_print = Dolphin_display.Safe_print

type equivalence = Strong

let ( let* ) = Result.bind

let write format output graph =
  match output with
  | None -> Exported_graph.write format stdout graph; Ok Exit_status.Done
  | Some path ->
    let* () = Text_file.write path (fun channel -> Exported_graph.write format channel graph) in
    Ok Exit_status.Done

let compare_graphs left right =
  match Compare.strong (Graph.without_doubles left) (Graph.without_doubles right) with
  | Ok () -> Safe_print.line "strongly bisimilar"; Exit_status.Done
  | Error difference ->
    Safe_print.format "not bisimilar@.%a@." Compare.pp_difference difference;
    Exit_status.Violated

(* Writing and comparing are ended by Ctrl-C at once. *)
let load world path =
  let found =
    Watched.search ~json:false (fun ~interrupted ~progress -> Exported_graph.load world ~interrupted ~progress path) in
  Sys.set_signal Sys.sigint Signal_default;
  found

type asked = {
  path : string;
  other : string option;  (** to compare with *)
  world : Exported_graph.world;
  format : Exported_graph.format;
  quotient : equivalence option;
  output : string option;
}

let run { path; other; world; format; quotient; output } =
  Minor_heap.enlarge ();
  Report.result
    (let* graph = load world path in
     match other, quotient with
     | Some other, _ -> Result.map (compare_graphs graph) (load world other)
     | None, Some Strong -> write format output (Partition.minimal (Graph.without_doubles graph))
     | None, None -> write format output graph)

(* {1 The command} *)

let graph =
  let doc = "A program, or a graph in a file that ends in $(b,.aut) or $(b,.json)." in
  Arg.(required & pos 0 (some string) None & info [] ~docv:"PROG" ~doc)

let compare_with =
  let doc =
    "Compare with the graph of $(docv), a program or a file as above: report whether they are strongly bisimilar, or \
     else the behaviour that only one of them has."
  in
  Arg.(value & opt (some string) None & info [ "compare" ] ~docv:"OTHER" ~doc)

let format =
  let formats = [ ("aut", Exported_graph.Aut); ("dot", Dot); ("json", Json) ] in
  let doc =
    "The format of the graph: $(b,aut), the Aldebaran format of CADP, mCRL2 and LTSmin; $(b,dot), for Graphviz; or \
     $(b,json)."
  in
  Arg.(value & opt (enum formats) Exported_graph.Aut & info [ "format" ] ~docv:"FORMAT" ~doc)

let quotient =
  let doc = "Write the smallest graph that is bisimilar: $(b,strong)." in
  let kinds = [ ("strong", Strong) ] in
  Arg.(value & opt (some (enum kinds)) None & info [ "quotient" ] ~docv:"KIND" ~doc)

let output =
  let doc = "Write to $(docv) instead of standard output." in
  Arg.(value & opt (some string) None & info [ "o"; "output" ] ~docv:"FILE" ~doc)

let workers =
  let doc =
    "Search with $(docv) processes once there are some 100,000 states. The graph is the same whatever $(docv) is." in
  Options.workers ~doc

let max_states =
  let doc = "Give up after $(docv) states." in
  Arg.(value & opt int 1_000_000 & info [ "max-states" ] ~docv:"N" ~doc)

let world =
  let open Options.Syntax in
  let+ set = Options.set
  and+ fleet = Options.fleet
  and+ answers = Explore_command.answers
  and+ faults = Explore_command.faults
  and+ workers = workers
  and+ max_states = max_states
  and+ max_memory = Explore_command.max_memory
  and+ timeout = Explore_command.timeout in
  { Exported_graph.set; fleet; answers; faults; workers; max_states; max_memory; timeout }

let asked =
  let open Options.Syntax in
  let+ path = graph
  and+ other = compare_with
  and+ world = world
  and+ format = format
  and+ quotient = quotient
  and+ output = output in
  { path; other; world; format; quotient; output }

let man =
  [ `S Manpage.s_description;
    `P "$(tname) writes the labelled transition system of a program in its world: its states are the configurations, \
        its transitions are steps, with the labels of $(i,docs/semantics.md): two steps with one label that lead to \
        one state are two transitions, as $(mname) $(b,explore) counts them. The world is that of $(mname) \
        $(b,explore).";
    `P "With $(b,--compare) it distinguishes two such graphs by a formula that holds for only one of them and, if \
        there is one, a run that only one of them has.";
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname) examples/parallel.dol -o parallel.aut\n\
         \  $(mname) $(tname) examples/parallel.dol --quotient strong --format dot | dot -Tsvg > parallel.svg\n\
         \  $(mname) $(tname) examples/parallel.dol --compare parallel.aut" ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "lts" ~docs:Options.s_prove ~doc:"write the state graph of a program, or compare graphs" ~man
      ~exits:(Options.exits [ Done; Violated; Bad_input; Inconclusive; Bug ])
  in
  Cmd.v info Term.(const run $ asked)
