open Cmdliner
open Dolphin_app
module Faults = Dolphin_environment.Faults

(* {1 The command} *)

let ( let* ) = Result.bind

(* As it is kept, if nothing has changed; or explored, and kept for the next time. *)
let find_or_explore settings program fleet ~from ~json ~period ~cache =
  let store = if cache then Verdict_store.make settings program fleet else None in
  match Option.bind store Verdict_store.find with
  | Some outcome ->
    Report.complain "nothing has changed: these are the stored verdicts";
    Ok outcome
  | None ->
    let explore ~interrupted ~progress = Exploration.explore ?from ~interrupted ~progress settings program fleet in
    let* outcome = Watched.search ~json ?period explore in
    let keep store = Result.iter_error Report.tell (Verdict_store.keep store outcome) in
    Option.iter keep store;
    Ok outcome

type files = {
  trace : string option;
  drawing : Drawing.t option;
  violation : string option;  (* of [trace] and [drawing] *)
  junit : string option;
  sarif : string option;
  certificate : string option;
}

(* Before anything is explored. *)
let check_files files =
  let check path f = Option.fold ~none:(Ok ()) ~some:f path in
  let* () =
    match files with
    | { violation = Some _; trace = None; drawing = None; junit = _; sarif = _; certificate = _ } ->
      Error (Error.Bad_input "--violation chooses the run of --trace and --draw: give one of these too")
    | { violation = _; trace = _; drawing = _; junit = _; sarif = _; certificate = _ } -> Ok ()
  in
  let* () = check files.trace Text_file.check in
  let* () = check files.drawing Drawing.check in
  let* () = check files.junit Text_file.check in
  let* () = check files.certificate Text_file.check in
  check files.sarif Text_file.check

(* All of them, although one cannot be written; the first error. *)
let write_files files program fleet ~strict outcome =
  let write path f = Option.fold ~none:(Ok ()) ~some:f path in
  let chosen =
    match files.violation with
    | None -> Ok (Exploration.counterexample ~strict outcome)
    | Some name -> Result.map Option.some (Exploration.counterexample_of name outcome)
  in
  let counterexample f = match chosen with Ok (Some found) -> f found | Ok None | Error _ -> Ok () in
  let trace = write files.trace (fun path -> counterexample (Exploration.write_witness program fleet path)) in
  let drawn = write files.drawing (fun drawing -> counterexample (Exploration.draw program fleet drawing)) in
  let junit = write files.junit (fun path -> Junit.write ~strict program path outcome) in
  let sarif = write files.sarif (fun path -> Sarif.write ~strict ~version:Version.number program path outcome) in
  List.fold_left (fun found next -> if Result.is_error found then found else next)
    (Result.map ignore chosen) [ trace; drawn; junit; sarif ]

(* Whether states can go to [directory]. *)
let check_spill (s : Exploration.settings) directory =
  let wrong format = Printf.ksprintf (fun why -> Error (Error.Bad_input why)) format in
  if s.max_memory = None then wrong "--spill is for states beyond a bound on memory: give --max-memory too"
  else if s.compress then wrong "states on disk are not compressed: give --spill or --compress, not both"
  else if s.walks <> None || s.bitstate <> None then
    wrong "random walks and bitstate hashing keep no states on disk: give --spill without --sample and --bitstate"
  else if not (Sys.file_exists directory) then wrong "--spill %s: no such directory" directory
  else if not (Sys.is_directory directory) then wrong "--spill %s: not a directory" directory
  else
    match Unix.access directory [ W_OK; X_OK ] with
    | () -> Ok ()
    | exception Unix.Unix_error (why, _, _) -> wrong "--spill %s: %s" directory (Unix.error_message why)

let check_search (s : Exploration.settings) =
  let not_both what = Error (Error.Bad_input (what ^ ", not both")) in
  let* () = Option.fold ~none:(Ok ()) ~some:(check_spill s) s.spill in
  match s.walks, s.bitstate, s.formulas with
  | _, _, [] when s.fairness = No_fairness ->
    Error (Error.Bad_input "--fairness none is about formulas: give --ltl too")
  | Some _, _, _ when s.fairness = Strong -> not_both "strong fairness needs all states: give --fairness or --sample"
  | _, Some _, _ when s.fairness = Strong -> not_both "strong fairness needs all states: give --fairness or --bitstate"
  | Some _, Some _, _ -> not_both "random walks keep their states: give --sample or --bitstate"
  | Some _, None, _ :: _ -> not_both "random walks cannot check a formula: give --sample or --ltl"
  | None, Some _, _ :: _ -> not_both "bitstate hashing cannot check a formula: give --bitstate or --ltl"
  | None, Some _, [] when s.compress ->
    not_both "bitstate hashing keeps no states that could be compressed: give --bitstate or --compress"
  | _, _, _ -> Ok ()

let check_certificate (s : Exploration.settings) files =
  if files.certificate <> None && (s.walks <> None || s.bitstate <> None) then
    Error (Error.Bad_input "a certificate is of all states: give --certify without --sample and --bitstate")
  else Ok ()

let certify settings program fleet ~json ~period outcome path =
  let make ~interrupted ~progress = State_certificate.make ~interrupted ~progress settings program fleet outcome in
  let* certificate = Watched.search ~json ?period make in
  State_certificate.write path certificate

let of_program settings (program : Program_file.t) fleet ~from ~strict ~json ~period ~files ~cache =
  Report.diagnostics ~source:program.source program.warnings;
  let* () = Option.fold files.violation ~none:(Ok ()) ~some:(Exploration.check_violation settings program) in
  let* outcome = find_or_explore settings program fleet ~from ~json ~period ~cache in
  let written = write_files files program fleet ~strict outcome in
  Result.iter_error Report.tell written;
  if json then print_endline (Dolphin_json.Canonical.to_string (Exploration_report.to_json ?from program outcome))
  else Exploration_report.print ?from ~strict program outcome;
  let certified =
    Option.fold files.certificate ~none:(Ok ()) ~some:(certify settings program fleet ~json ~period outcome) in
  let* () = certified in
  match written with
  | Ok () -> Ok (Exit_status.of_verdict (Exploration.verdict ~strict outcome))
  | Error (Error.Bad_input _) -> Ok Exit_status.Bad_input
  | Error _ -> Ok Exit_status.Platform_trouble

let of_values settings sweep fleet ~strict ~json ~period ~files ~cache =
  let are_files =
    match files with
    | { trace = None; drawing = None; violation = _; junit = None; sarif = None; certificate = None } -> false
    | { trace = _; drawing = _; violation = _; junit = _; sarif = _; certificate = _ } -> true
  in
  if cache || are_files then
    let options = "--trace, --draw, --junit, --sarif, --certify and --cache" in
    Error (Error.Bad_input (options ^ " are for one program: give --set no range of values"))
  else
    let ask ~interrupted ~progress =
      Sweep.rows sweep ~interrupted (fun program ->
          let* outcome = Exploration.explore ~interrupted ~progress settings program fleet in
          Ok (outcome, Exploration.verdict ~strict outcome))
    in
    let* rows = Watched.search ~json ?period ask in
    if json then print_endline (Dolphin_json.Canonical.to_string (Explore_sweep.to_json sweep rows))
    else Explore_sweep.print ~strict sweep rows;
    Ok (Exit_status.of_verdict (Sweep.verdict rows))

(* The rest of the run whose journal is [journal]. *)
let rest_of_run settings path set named ~journal ~strict ~json ~period ~files ~cache =
  let* () =
    match files, cache with
    | { trace = None; drawing = None; violation = _; junit = _; sarif = _; certificate = None }, false -> Ok ()
    | { trace = _; drawing = _; violation = _; junit = _; sarif = _; certificate = _ }, _ ->
      let options = "--trace, --draw, --certify and --cache" in
      Error (Error.Bad_input (options ^ " are for runs from the beginning: leave them out with --from"))
  in
  let* present, program, fleet = Present.load path ~set ~fleet:named ~journal in
  let remarks = Present.remarks present program fleet in
  let remarks = remarks @ Ignored_faults.of_assumptions program.program fleet in
  List.iter Report.complain (remarks @ Ignored_faults.sentences settings.Exploration.faults fleet);
  of_program settings program fleet ~from:(Some present) ~strict ~json ~period ~files ~cache

let all_runs settings path set named ~strict ~json ~period ~files ~cache =
  let* question = Sweep.question ~set path in
  let* fleet = Fleet_file.load_for ~program:path named in
  let* question = Sweep.within fleet question in
  List.iter Report.complain (Ignored_faults.sentences settings.Exploration.faults fleet);
  match question with
  | One program ->
    List.iter Report.complain (Ignored_faults.of_assumptions program.program fleet);
    of_program settings program fleet ~from:None ~strict ~json ~period ~files ~cache
  | Several sweep -> of_values settings sweep fleet ~strict ~json ~period ~files ~cache

(* What is asked, and how it is shown. *)
type asked = {
  path : string;
  set : (string * string) list;
  fleet : string option;
  from : string option;
  strict : bool;
  json : bool;
  period : float option;
  files : files;
  cache : bool;
}

let run { path; set; fleet; from; strict; json; period; files; cache } settings =
  Minor_heap.enlarge ();
  Report.result
    (let* () = check_search settings in
     let* () = check_files files in
     let* () = check_certificate settings files in
     match from with
     | Some journal -> rest_of_run settings path set fleet ~journal ~strict ~json ~period ~files ~cache
     | None -> all_runs settings path set fleet ~strict ~json ~period ~files ~cache)

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
    | Some _ | None -> Error (`Msg (Printf.sprintf "'%s' is not a size such as 512M or 8G" text))
  in
  Arg.conv ~docv:"SIZE" (parse, Format.pp_print_int)

let faults =
  let parse text = Result.map_error (fun why -> `Msg why) (Faults.of_string text) in
  let doc =
    "Further faults, separated by commas: $(b,fail), every platform task may fail; $(b,loss), the connection of a \
     vehicle that runs a task may be lost for longer than its timeout; $(b,join), vehicles with $(b,joins), \
     $(b,leaves) or $(b,drops) in the fleet, or if there are none, all vehicles, may be late or missing when the \
     program picks them; $(b,all) of these. $(b,interrupt), which is not part of $(b,all): the program may be \
     interrupted at any time, as by Ctrl-C. With $(b,=)$(i,N) at most $(i,N) times in one run: $(b,fail=1,loss=2). By \
     default only plans with $(b,mayFail) in the fleet may fail, or any plan in a program with fences."
  in
  Arg.(value & opt (conv ~docv:"FAULTS" (parse, Faults.pp)) Faults.none & info [ "faults" ] ~docv:"FAULTS" ~doc)

let bound kind name docv doc = Arg.(value & opt (some kind) None & info [ name ] ~docv ~doc)
let max_states = bound Arg.int "max-states" "N" "Stop after $(docv) states."
let max_depth = bound Arg.int "max-depth" "N" "Follow runs for at most $(docv) transitions."
let max_memory = bound size "max-memory" "SIZE" 
    "Stop before the process takes more than $(docv) of memory, as in 512M or 8G; it starts with some 20M. By \
     default, the limit is nine tenths of the memory left by the machine and by the limits on the process."
let timeout = bound Arg.float "timeout" "SECONDS" "Stop after $(docv) seconds."

let from =
  Options.from
    "Explore the possible continuations of the run $(docv), from the end of its journal. Vehicles start where they \
     were seen last; tasks of a vehicle out of contact may fail. Not with $(b,--trace), $(b,--draw), \
     $(b,--certify) and $(b,--cache)."

let answers =
  let doc =
    "A possible answer to the program's questions. May be repeated. The default is the answers of the fleet."
  in
  Arg.(value & opt_all string [] & info [ "answer" ] ~docv:"TEXT" ~doc)

let strict =
  let doc =
    "Count as violations what is otherwise only noted: $(b,halt), tuples left over (except those with the key of an \
     $(b,input)), unreachable code."
  in
  Arg.(value & flag & info [ "strict" ] ~doc)

let invariants =
  let doc =
    "Check that $(docv) holds in every state. It is an expression of the language over the global variables of the \
     program, with $(b,running\\('plan'\\)), $(b,running\\('plan', 'vehicle'\\)), $(b,bound\\('vehicle'\\)) and \
     $(b,poll\\(key: value\\)) in addition. While a variable in it has no value, it holds. May be repeated."
  in
  Arg.(value & opt_all string [] & info [ "invariant" ] ~docv:"EXPR" ~doc)

let formulas =
  let doc =
    "Check that every run satisfies the formula of linear temporal logic $(docv), as in $(b,G \\(start\\(survey1\\) -> \
     F done\\(survey1\\)\\)): with $(b,!), $(b,&), $(b,|), $(b,->), $(b,<->), $(b,X), $(b,F), $(b,G), $(b,U), $(b,R), \
     $(b,W). $(i,docs/questions.md) lists its propositions. May be repeated."
  in
  Arg.(value & opt_all string [] & info [ "ltl" ] ~docv:"FORMULA" ~doc)

let fairness =
  let kinds = [ ("weak", Dolphin_explore.Search.Weak); ("strong", Strong); ("none", No_fairness) ] in
  let doc =
    "The runs that termination and $(b,--ltl) are about: with $(b,weak), runs that are fair (running tasks end some \
     time, timers expire, no step that stays possible is put off without end), and endless runs without any event; \
     with $(b,strong), a plan that is begun and cut off again and again is done at some time, too; with $(b,none), \
     $(b,--ltl) is about all runs."
  in
  Arg.(value & opt (enum kinds) Weak & info [ "fairness" ] ~docv:"KIND" ~doc)

let run_file =
  let parse path =
    match String.lowercase_ascii (Filename.extension path) with
    | ".svg" | ".html" | ".htm" ->
      Error (`Msg (Printf.sprintf "'%s' is the name of a picture, but JSON would be written" path))
    | _ -> Ok path
  in
  Arg.conv ~docv:"FILE" (parse, Format.pp_print_string)

let trace =
  let doc =
    "Write the first run shown, or that of $(b,--violation), into the file $(docv). $(mname) $(b,exec --follow) \
     $(docv) replays it. If its name ends in $(b,.itf.json), it is written in the Informal Trace Format instead, for \
     the tools of TLA+ and Quint. Nothing is written if there is none."
  in
  Arg.(value & opt (some run_file) None & info [ "trace" ] ~docv:"FILE" ~doc)

let file name doc =
  let parse path = if path = "-" then Error (`Msg "'-' is not a file name") else Ok path in
  let path = Arg.conv ~docv:"FILE" (parse, Format.pp_print_string) in
  Arg.(value & opt (some path) None & info [ name ] ~docv:"FILE" ~doc)

let files =
  let junit =
    file "junit" "Write the verdicts into $(docv) as JUnit's XML too, with a test case for each property, for tools \
                  that collect test results."
  in
  let sarif =
    file "sarif" "Write the verdicts into $(docv) as SARIF 2.1.0 too, with the runs shown as code flows, for code \
                  hosts and editors."
  in
  let drawing =
    let doc =
      "Draw the first run shown, or that of $(b,--violation), in the file $(docv), $(i,*.svg) or $(i,*.html): the \
       tasks of each vehicle by steps, since such a run has no times. Nothing is drawn if there is none."
    in
    Arg.(value & opt (some Options.drawing) None & info [ "draw" ] ~docv:"FILE" ~doc)
  in
  let violation =
    let doc =
      "The run that $(b,--trace) and $(b,--draw) write: one that violates the property $(docv), named as in the \
       report, such as $(b,termination), also if it is only noted. If none is known, the properties that have one are \
       listed, and the exit status is 2."
    in
    Arg.(value & opt (some string) None & info [ "violation" ] ~docv:"NAME" ~doc)
  in
  let certificate =
    file "certify"
      "Write all states of $(i,PROG) with their transitions into $(docv), without any reduction, and the properties \
       that hold in all of them. The checker in $(i,proofs/reference), which is proved, compares it with the rules: \
       see $(i,docs/proofs.md). Invariants, formulas and distances are not in it. Not with $(b,--from), \
       $(b,--sample) and $(b,--bitstate)."
  in
  let open Options.Syntax in
  let+ trace = trace
  and+ drawing = drawing
  and+ violation = violation
  and+ junit = junit
  and+ sarif = sarif
  and+ certificate = certificate in
  { trace; drawing; violation; junit; sarif; certificate }

let period =
  let doc =
    "Print the progress of the search on standard error, a line every $(docv) seconds. By default, a terminal always \
     shows the progress, and a log has a line every ten seconds, or none with $(b,--json)."
  in
  Arg.(value & opt (some (Options.positive ~docv:"SECONDS")) None & info [ "progress" ] ~docv:"SECONDS" ~doc)

let cache =
  let doc =
    "Store the verdicts, unless one is inconclusive, and print the stored ones if nothing has changed: neither \
     $(i,PROG) nor the fleet, the options or $(mname) itself. They are stored below $(b,dolphin/explore) in \
     $(b,XDG_CACHE_HOME), by default $(b,~/.cache)."
  in
  Arg.(value & flag & info [ "cache" ] ~doc)

let reduction =
  let kinds =
    [ ("none", Dolphin_explore.Reduction.Whole); ("por", Partial_order); ("symmetry", Symmetry); ("all", All) ]
  in
  let doc =
    "The explored states: with $(b,none), all of them; with $(b,por), only one order of steps where orders make no \
     difference (partial order reduction); with $(b,symmetry), one representative of all states that differ by \
     exchanging vehicles, plans and tuples that the program treats alike, in tasks and in the results of $(b,pick); \
     with $(b,all), both. The verdicts are the same. With an $(b,--invariant) only vehicles are exchanged. The number \
     of states printed is that of the explored states, followed by the reductions used."
  in
  Arg.(value & opt (enum kinds) All & info [ "reduction" ] ~docv:"KIND" ~doc)

let compress =
  let doc =
    "Store each state in some 12 bytes instead of 28 or more, which takes about twice the time."
  in
  Arg.(value & flag & info [ "compress" ] ~doc)

let spill =
  let doc =
    "Store states beyond $(b,--max-memory) in a file of the directory $(docv), 8 bytes for each 62 bits of a state, \
     up to the capacity of the disk. The whole file is read at each depth of the search. It has no name, so nothing \
     is left of it, however the search ends. A full disk is a bound that was met. Not with $(b,--compress), \
     $(b,--sample) or $(b,--bitstate)."
  in
  Arg.(value & opt (some string) None & info [ "spill" ] ~docv:"DIR" ~doc)

let positive = Options.whole ~docv:"N" "not a number from 1 on"

let walks =
  let sample =
    let doc =
      "Follow $(docv) random walks instead of all runs, for programs too large to be explored. Each state's \
       transitions are equally likely; the successors not taken are checked, too. A walk ends with the run, or after \
       $(b,--max-depth) transitions (10,000 by default). Violations are real, and shown with their run; otherwise the \
       result is inconclusive, unless the walks visited every state. The number of missed states is estimated. Not \
       with $(b,--ltl)."
    in
    Arg.(value & opt (some positive) None & info [ "sample" ] ~docv:"WALKS" ~doc)
  in
  let seed =
    let doc = "The seed of $(b,--sample). By default a new one is drawn, and printed." in
    Arg.(value & opt (some int) None & info [ "seed" ] ~docv:"N" ~doc)
  in
  let by_time () = int_of_float (Unix.gettimeofday () *. 1_000.) mod 1_000_000 in
  let make number seed =
    let seed = match seed with Some seed -> seed | None -> by_time () in
    Option.map (fun number -> { Dolphin_explore.Search.number; seed }) number
  in
  Term.(const make $ sample $ seed)

let bitstate =
  let doc =
    "Distinguish states by three bits each in an array of $(docv) bytes, as in 256M, instead of storing them, for \
     programs with too many states (bitstate hashing). States are explored depth first, no deeper than \
     $(b,--max-depth). Violations are real, and shown with their run; otherwise the result is inconclusive, since \
     some states may be missed: the expected number of missed states is printed. Cycles of a $(b,repeat) without a \
     number of rounds are not judged. Not with $(b,--ltl), $(b,--sample) or $(b,--compress)."
  in
  Arg.(value & opt (some size) None & info [ "bitstate" ] ~docv:"SIZE" ~doc)

let workers =
  let doc =
    "Search with $(docv) processes once there are some 100,000 states. The verdicts are the same whatever $(docv) is; \
     another one of several shortest runs may be shown. With symmetry of tasks, the number of states may differ. \
     There is one process with $(b,--compress), $(b,--spill), $(b,--sample) and $(b,--bitstate)."
  in
  Options.workers ~doc

let json = Arg.(value & flag & info [ "json" ] ~doc:"Print the result as one JSON object.")

let man =
  [ `S Manpage.s_description;
    `P "$(tname) follows every run of $(i,PROG): every order in which tasks end and timers expire, every choice of \
        vehicles, every branch that is ready. It uses the transition function of $(mname) $(b,exec). For each of \
        these properties it reports that it holds, or shows a run that violates it (a shortest one where so marked, \
        and with $(b,--faults) one with as few faults as can be), with a column for the program and one for each \
        vehicle:";
    `I ("no deadlock", "some transition is possible until the program ends.");
    `I
      ("termination",
       "every fair run ends: tasks that run end some time, timers expire, no step is put off without end.");
    `I ("no unhandled error", "no fault, and no error of a task that nothing handles.");
    `I ("assertions", "no $(b,assert) of the program fails.");
    `I ("vehicles for all picks", "every $(b,pick) gets its vehicles. Printed only if it does not hold.");
    `I ("vehicles for all tasks", "every $(b,execute) gets its vehicles.");
    `P "With a $(b,fence distance), it also reports plans that may run side by side and whose ways come nearer to \
        each other.";
    `P "Noted are also runs that call $(b,halt), tuples left over at the end, and code that no run reaches.";
    `P "Sensor readings are open: both outcomes of a condition such as $(b,battery\\(v\\) < 0.3) are possible, or the \
        outcomes for the values given in the fleet. Between two events a sensor keeps its value. A run lists its \
        assumptions. All vehicles of the fleet are in reach, unless $(b,--faults) is given. Calls of a supplier get \
        each of the replies that the fleet gives for them; a call without a reply fails.";
    `P "Progress goes to standard error: on a terminal all the time, in a log as a line every ten seconds.";
    `P "A bound that is met, or Ctrl-C, makes the verdict inconclusive where no violation was found: a property never \
        counts as holding when it was not completely explored.";
    `S Manpage.s_arguments;
    `S Manpage.s_options;
    `S Manpage.s_exit_status;
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname) examples/rendezvous.dol\n  $(mname) $(tname) examples/rendezvous.dol --faults fail=1\n\
         \  $(mname) $(tname) mission.dol --invariant \"!(running('a') && running('b'))\"\n\
         \  $(mname) $(tname) mission.dol --ltl 'G (start(survey1) -> F done(survey1))'\n\
         \  $(mname) $(tname) mission.dol --max-memory 8G --timeout 60\n\
         \  $(mname) $(tname) mission.dol --from latest --faults loss=1\n\
         \  $(mname) $(tname) mission.dol --max-memory 2G --spill /var/tmp" ]
  @ Options.see_also

let asked =
  let open Options.Syntax in
  let+ path = Options.program
  and+ set = Options.set_range
  and+ fleet = Options.fleet
  and+ from = from
  and+ strict = strict
  and+ json = json
  and+ period = period
  and+ files = files
  and+ cache = cache in
  { path; set; fleet; from; strict; json; period; files; cache }

let settings =
  let open Options.Syntax in
  let+ answers = answers
  and+ faults = faults
  and+ reduction = reduction
  and+ compress = compress
  and+ spill = spill
  and+ walks = walks
  and+ bitstate = bitstate
  and+ workers = workers
  and+ invariants = invariants
  and+ formulas = formulas
  and+ fairness = fairness
  and+ max_states = max_states
  and+ max_depth = max_depth
  and+ max_memory = max_memory
  and+ timeout = timeout in
  { Exploration.answers; faults; reduction; compress; spill; walks; bitstate; workers; max_states; max_depth;
    max_memory; timeout; invariants; formulas; fairness }

let command =
  let info =
    Cmd.info "explore" ~docs:Options.s_prove ~doc:"check every run of a program" ~man
      ~exits:(Options.exits [ Done; Violated; Bad_input; Inconclusive; Platform_trouble; Bug ])
  in
  Cmd.v info
    Term.(const run $ asked $ settings)
