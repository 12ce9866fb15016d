open Cmdliner
module Search = Dolphin_explore.Search
module Environment = Dolphin_environment.Environment
module Value = Dolphin_semantics.Value
module Property = Dolphin_explore.Property
module Faults = Dolphin_environment.Faults
module Scenario_world = Dolphin_environment.Scenario_world
module Witness = Dolphin_trace.Witness

type settings = {
  answers : string list;
  faults : Faults.t;
  strict : bool;
  json : bool;
  trace : string option;
  reduction : Dolphin_explore.Reduction.t;
  compress : bool;
  max_states : int option;
  max_depth : int option;
  max_memory : int option;
  timeout : float option;
}

(* Without [--strict] these are worth knowing, but a program may mean them. *)
let is_remark : Property.t -> bool = function
  | No_halt | No_leftover | All_reached -> true
  | No_deadlock | Termination | No_error | Assertions | Vehicles | Invariant _ | Formula _ -> false

(* {1 Progress} *)

let mebibytes bytes = bytes / 1024 / 1024

let show_progress (p : Search.progress) =
  Printf.eprintf "\r%s: %d states, %.0f/s, frontier %d, depth %d, %d MiB, %.0f s\027[K%!" p.phase p.states p.rate
    p.frontier p.depth (mebibytes p.memory) p.elapsed

let clear_progress () = Printf.eprintf "\r\027[K%!"

(* {1 Results} *)

let print_pieces (program : Dolphin_semantics.Core.program) pieces =
  List.iter
    (fun (piece : Dolphin_explore.Coverage.piece) ->
       Format.printf "  %a: %s@." Dolphin_syntax.Location.pp program.locations.(piece.site) piece.what)
    pieces

(* The call for which the fleet has no reply, if the run ends with one. *)
let lacking (run : Search.run) =
  match List.rev run.steps with
  | { label = No_reply why; _ } :: { label = Call call; _ } :: _ when why = Environment.no_reply call -> Some call
  | _ -> None

let print_outcome program s (o : Search.outcome) =
  let with_remark (property, verdict) = (property, verdict, is_remark property && not s.strict) in
  let shown = List.map with_remark o.verdicts in
  List.iter
    (fun (property, (verdict : Search.verdict), remark) ->
       match verdict with
       | (Holds | Inconclusive _) when remark -> ()
       | Holds | Violated _ | Unreached _ | Inconclusive _ ->
         Format.printf "%s%a@." (if remark then "note: " else "") (Search.pp_verdict program) (property, verdict))
    shown;
  let reduced =
    match Search.reductions o with
    | [] -> ""
    | names -> "; reduced by " ^ String.concat ", " names
  in
  let for_formulas = if o.formula_states = 0 then "" else Printf.sprintf "; %d states for formulas" o.formula_states in
  Printf.printf "%d states, %d transitions, depth %d, %.2f s, %d MiB%s%s\n" o.states o.transitions o.depth o.seconds
    (mebibytes o.bytes) reduced for_formulas;
  List.iter
    (fun (property, (verdict : Search.verdict), remark) ->
       match verdict with
       | Violated run when not remark ->
         Format.printf "@.%s: a%s run in which %s@." (Property.name property)
           (if run.shortest then " shortest" else "")
           (Property.question property);
         Shown_run.print program ~steps:run.steps ~cycle:run.cycle;
         if property = No_deadlock then Shown_run.print_waiting program run.steps;
         let tell call =
           Format.printf "the fleet lacks an entry: reply %a, and what the supplier may reply@." Value.pp (String call)
         in
         Option.iter tell (lacking run)
       | Unreached pieces when not remark ->
         Format.printf "@.%s: no run reaches@." (Property.name property);
         print_pieces program pieces
       | Holds | Inconclusive _ | Violated _ | Unreached _ -> ())
    shown

let json_of_run (run : Search.run) =
  let labels steps =
    `List
      (List.map
         (fun (t : Dolphin_semantics.Transition.t) ->
            `String (Format.asprintf "%a" Dolphin_semantics.Label.pp t.label))
         steps)
  in
  let assumed i (t : Dolphin_semantics.Transition.t) =
    let what a = `String (Format.asprintf "%a" Dolphin_semantics.World.pp_assumption a) in
    if t.assumed = [] then None
    else Some (`Assoc [ ("step", `Int (i + 1)); ("assumed", `List (List.map what t.assumed)) ])
  in
  let assumptions = List.filter_map Fun.id (List.mapi assumed (run.steps @ run.cycle)) in
  [ ("shortest", `Bool run.shortest); ("run", labels run.steps); ("cycle", labels run.cycle) ]
  @ if assumptions = [] then [] else [ ("assumptions", `List assumptions) ]

let json_of_outcome (program : Dolphin_semantics.Core.program) (o : Search.outcome) : Yojson.Safe.t =
  let verdict (property, verdict) =
    let name = `String (Property.name property) in
    let result, more =
      match (verdict : Search.verdict) with
      | Holds -> ("holds", [])
      | Violated run -> ("violated", json_of_run run)
      | Unreached pieces ->
        let piece (p : Dolphin_explore.Coverage.piece) =
          let at = Format.asprintf "%a" Dolphin_syntax.Location.pp program.locations.(p.site) in
          `Assoc [ ("at", `String at); ("what", `String p.what) ]
        in
        ("violated", [ ("unreached", `List (List.map piece pieces)) ])
      | Inconclusive bound ->
        ("inconclusive", [ ("bound", `String (Format.asprintf "%a" Search.pp_bound bound)) ])
    in
    `Assoc ([ ("property", name); ("verdict", `String result) ] @ more)
  in
  `Assoc
    [ ("states", `Int o.states); ("transitions", `Int o.transitions); ("depth", `Int o.depth);
      ("seconds", `Float o.seconds); ("bytes", `Int o.bytes); ("formula_states", `Int o.formula_states);
       ("reductions", `List (List.map (fun name -> `String name) (Search.reductions o)));
      ("verdicts", `List (List.map verdict o.verdicts)) ]

(* The first of the runs that are shown. *)
let counter_example strict (o : Search.outcome) =
  List.find_map
    (fun (property, verdict) ->
       match (verdict : Search.verdict) with
       | Violated run when strict || not (is_remark property) -> Some (property, run)
       | Violated _ | Holds | Unreached _ | Inconclusive _ -> None)
    o.verdicts

let as_course (program : Program_file.t) (fleet : Fleet_file.t) world property (run : Search.run) =
  let source path text = Dolphin_trace.Header.source ~path text in
  let steps = Witness.steps program.program world in
  let initial = Dolphin_semantics.Configuration.initial program.program in
  let last (_ : Dolphin_semantics.Configuration.t) (t : Dolphin_semantics.Transition.t) = t.next in
  Witness.to_lines
    { program = source program.path program.source;
      fleet = Option.map (fun path -> source path fleet.source) fleet.path;
      property = Property.name property;
      steps = steps initial run.steps;
      cycle = steps (List.fold_left last initial run.steps) run.cycle }

let as_itf (program : Program_file.t) property (run : Search.run) =
  let description = Printf.sprintf "%s: %s" (Property.name property) (Property.question property) in
  let initial = Dolphin_semantics.Configuration.initial program.program in
  let trace = Dolphin_trace.Itf.trace program.program ~description initial run.steps ~cycle:run.cycle in
  [ Yojson.Safe.to_string trace ]

let write_trace program fleet world path (property, run) =
  match open_out_bin path with
  | exception Sys_error why -> Report.complain why; Some Exit_status.Platform_trouble
  | channel ->
    let write () =
      let lines =
        if Filename.check_suffix path ".itf.json" then as_itf program property run
        else as_course program fleet world property run
      in
      List.iter (fun line -> output_string channel (line ^ "\n")) lines
    in
    Fun.protect ~finally:(fun () -> close_out channel) write;
    None

let status strict (o : Search.outcome) : Exit_status.t =
  let matters (property, _) = strict || not (is_remark property) in
  let verdicts = List.map snd (List.filter matters o.verdicts) in
  let is_violated = function Search.Violated _ | Unreached _ -> true | Holds | Inconclusive _ -> false in
  let is_open = function Search.Inconclusive _ -> true | Holds | Violated _ | Unreached _ -> false in
  if List.exists is_violated verdicts then Violated else if List.exists is_open verdicts then Inconclusive else Done

(* {1 The command} *)

let explore (program : Program_file.t) (fleet : Fleet_file.t) s invariants formulas =
  let interrupted = ref false in
  Sys.set_signal Sys.sigint (Signal_handle (fun _ -> interrupted := true));
  let live = Unix.isatty Unix.stderr && not s.json in
  let options : Search.options =
    { environment = Scenario_world.environment ~answers:s.answers ~faults:s.faults fleet.scenario;
      reduction = s.reduction; compress = s.compress;
      search_again = Search.default.search_again;
      max_states = s.max_states; max_depth = s.max_depth; max_memory = s.max_memory; memory_left = Memory.left;
      timeout = s.timeout;
      clock = Unix.gettimeofday;
      invariants; formulas;
      interrupted = (fun () -> !interrupted);
      progress = (if live then show_progress else ignore) }
  in
  let outcome = Search.run options program.program (Scenario_world.world fleet.scenario) in
  if live then clear_progress ();
  let world = Scenario_world.world fleet.scenario in
  let trouble =
    match s.trace, counter_example s.strict outcome with
    | Some path, Some found -> write_trace program fleet world path found
    | Some _, None | None, _ -> None
  in
  if s.json then print_endline (Yojson.Safe.to_string (json_of_outcome program.program outcome))
  else print_outcome program.program s outcome;
  Option.value trouble ~default:(status s.strict outcome)

(* Each of [texts] read by [of_string], or the first that is wrong. *)
let read_all option of_string texts =
  let read result text =
    match result, of_string text with
    | Error _, _ -> result
    | Ok _, Error why -> Error (Printf.sprintf "%s '%s': %s" option text why)
    | Ok found, Ok x -> Ok (x :: found)
  in
  Result.map List.rev (List.fold_left read (Ok []) texts)

let run path fleet answers faults strict json trace reduction compress invariants formulas max_states max_depth max_memory
    timeout =
  match Program_file.load path, Fleet_file.load (Fleet_file.choose ~program:path fleet) with
  | Error trouble, _ -> Program_file.tell trouble; Exit_status.Bad_input
  | Ok _, Error trouble -> Fleet_file.tell trouble; Exit_status.Bad_input
  | Ok program, Ok fleet ->
    Report.diagnostics ~source:program.source program.warnings;
    let settings =
      { answers; faults; strict; json; trace; reduction; compress; max_states; max_depth; max_memory; timeout }
    in
    let program' = program.program in
    (match read_all "--invariant" (Dolphin_explore.Condition.of_string program') invariants,
           read_all "--ltl" (Dolphin_explore.Temporal.of_string program') formulas with
    | Error why, _ | _, Error why -> Report.complain why; Bad_input
    | Ok invariants, Ok formulas -> explore program fleet settings invariants formulas)

(* A number of bytes, as in 512M or 8G. *)
let size =
  let parse text =
    let n = String.length text in
    let scaled unit = Option.map (fun x -> x * unit) (int_of_string_opt (String.sub text 0 (n - 1))) in
    let bytes =
      if n = 0 then None
      else
        match text.[n - 1] with
        | 'K' | 'k' -> scaled 1024
        | 'M' | 'm' -> scaled (1024 * 1024)
        | 'G' | 'g' -> scaled (1024 * 1024 * 1024)
        | _ -> int_of_string_opt text
    in
    match bytes with
    | Some bytes when bytes > 0 -> Ok bytes
    | Some _ | None -> Error (`Msg (Printf.sprintf "'%s' is no size such as 512M or 8G" text))
  in
  Arg.conv ~docv:"SIZE" (parse, Format.pp_print_int)

let faults =
  let parse text = Result.map_error (fun why -> `Msg why) (Faults.of_string text) in
  let doc =
    "What else may go wrong, separated by commas: $(b,fail), every platform task may fail; $(b,loss), the connection of a \
     vehicle that runs a task may be lost for longer than its timeout; $(b,join), vehicles may be late or missing when \
     the program picks them: those that the fleet lets join, leave or drop, or if there are none, all; $(b,all) of \
     these. $(b,interrupt), which is not among $(b,all): the program may be interrupted at any time, as by Ctrl-C. With \
     $(b,=)$(i,N) at most $(i,N) times in one run: $(b,fail=1,loss=2). By default only those plans may fail of which the \
     fleet says so."
  in
  Arg.(value & opt (conv ~docv:"FAULTS" (parse, Faults.pp)) Faults.none & info [ "faults" ] ~docv:"FAULTS" ~doc)

let bound kind name docv doc = Arg.(value & opt (some kind) None & info [ name ] ~docv ~doc)
let max_states = bound Arg.int "max-states" "N" "Stop after $(docv) states."
let max_depth = bound Arg.int "max-depth" "N" "Follow runs for $(docv) transitions only."
let max_memory = bound size "max-memory" "SIZE" 
    "Stop before more than $(docv) of memory is used, as in 512M or 8G. Without it, the search stops before it has nine \
     tenths of what the machine, and the limits on the process, leave to it."
let timeout = bound Arg.float "timeout" "SECONDS" "Stop after $(docv) seconds."

let answers =
  let doc =
    "What may be answered to the program's questions. If repeated, each of them may be. The default is what the fleet \
     answers."
  in
  Arg.(value & opt_all string [] & info [ "answer" ] ~docv:"TEXT" ~doc)

let strict =
  let doc =
    "Count as violations what otherwise is only noted: $(b,halt), tuples left over, code that no run reaches."
  in
  Arg.(value & flag & info [ "strict" ] ~doc)

let invariants =
  let doc =
    "Check that $(docv) holds in every state. It is an expression of the language over the global variables of the \
     program, in which also $(b,running\\('plan'\\)), $(b,running\\('plan', 'vehicle'\\)), $(b,bound\\('vehicle'\\)) \
     and $(b,poll\\(key: value\\)) may stand. As long as a variable in it has no value, it holds. May be repeated."
  in
  Arg.(value & opt_all string [] & info [ "invariant" ] ~docv:"EXPR" ~doc)

let formulas =
  let doc =
    "Check that every run satisfies the formula of linear temporal logic $(docv), as in $(b,G \\(start\\(survey1\\) -> F \
     done\\(survey1\\)\\)): with $(b,!), $(b,&), $(b,|), $(b,->), $(b,<->), $(b,X), $(b,F), $(b,G), $(b,U), $(b,R), \
     $(b,W). $(i,docs/questions.md) lists its propositions. May be repeated."
  in
  Arg.(value & opt_all string [] & info [ "ltl" ] ~docv:"FORMULA" ~doc)

let trace =
  let doc =
    "Write the first of the runs that are shown into the file $(docv). $(mname) $(b,exec --follow) $(docv) replays it. If \
     its name ends in $(b,.itf.json), it is written in the Informal Trace Format instead, for the tools of TLA+ and \
     Quint. Nothing is written if there is none."
  in
  let parse path =
    match String.lowercase_ascii (Filename.extension path) with
    | ".svg" | ".html" | ".htm" ->
      Error (`Msg (Printf.sprintf "'%s' is the name of a picture, and what is written is JSON" path))
    | _ -> Ok path
  in
  let run_file = Arg.conv ~docv:"FILE" (parse, Format.pp_print_string) in
  Arg.(value & opt (some run_file) None & info [ "trace" ] ~docv:"FILE" ~doc)

let reduction =
  let kinds =
    [ ("none", Dolphin_explore.Reduction.Whole); ("por", Partial_order); ("symmetry", Symmetry); ("all", All) ]
  in
  let doc =
    "How much is looked at: $(b,none) for every state; $(b,por) for one of the orders that make no difference (partial \
     order reduction); $(b,symmetry) for one of those that differ by exchanging vehicles, plans and tuples that are \
     alike, in tasks and in what $(b,pick) gives; $(b,all) for both. The verdicts are the same. Beside an $(b,--invariant) only vehicles are \
     exchanged. The number of states printed is that of \
     the states looked at, and which reductions were used is said behind it."
  in
  Arg.(value & opt (enum kinds) All & info [ "reduction" ] ~docv:"KIND" ~doc)

let compress =
  let doc =
    "Keep the states in some 12 bytes each instead of 28 (or more, if they are large), which takes about twice the time."
  in
  Arg.(value & flag & info [ "compress" ] ~doc)

let json = Arg.(value & flag & info [ "json" ] ~doc:"Print the result as one JSON object.")

let man =
  [ `S Manpage.s_description;
    `P "$(tname) follows every run that $(i,PROG) can have: every order in which tasks end and timers expire, every choice \
        of vehicles, every branch that is ready. It uses the very transition function that $(mname) $(b,exec) uses. \
        For each of these it says whether it holds, or shows a run that breaks it, a shortest one if it says so, a \
        column for the program and one \
        for each vehicle:";
    `I ("no deadlock", "some transition is possible until the program ends.");
    `I
      ("termination",
       "every fair run ends: tasks that run end some time, timers expire, no step is put off for ever.");
    `I ("no unhandled error", "no fault, and no error of a task that nothing handles.");
    `I ("assertions", "no $(b,assert) of the program fails.");
    `I ("vehicles for all tasks", "every $(b,pick) and every $(b,execute) gets its vehicles.");
    `P "Noted are also runs that call $(b,halt), tuples left over at the end, and code that no run reaches.";
    `P "What sensors show is open: of a condition such as $(b,battery\\(v\\) < 0.3) both outcomes are possible at each look, \
        or those for the values that the fleet gives; a run says what it assumes. All vehicles of the fleet are in \
        reach, unless $(b,--faults) says otherwise. Calls of a supplier get each of the replies that the fleet gives for \
        them; a call for which it has none fails.";
    `P "A bound that is met, or Ctrl-C, makes the answer inconclusive where no violation was found: it is never said that \
        something holds that was not wholly explored.";
    `S Manpage.s_arguments;
    `S Manpage.s_options;
    `S Manpage.s_exit_status;
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname) examples/rendezvous.dol\n  $(mname) $(tname) examples/rendezvous.dol --faults fail=1\n\
         \  $(mname) $(tname) mission.dol --invariant \"!(running('a') && running('b'))\"\n\
         \  $(mname) $(tname) mission.dol --ltl 'G (start(survey1) -> F done(survey1))'\n\
         \  $(mname) $(tname) mission.dol --max-memory 8G --timeout 60" ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "explore" ~doc:"check every run of a program" ~man
      ~exits:(Options.exits [ Done; Violated; Bad_input; Inconclusive; Platform_trouble; Bug ])
  in
  Cmd.v info
    Term.(
      const run $ Options.program $ Options.fleet $ answers $ faults $ strict $ json $ trace $ reduction $ compress
      $ invariants $ formulas $ max_states $ max_depth $ max_memory $ timeout)
