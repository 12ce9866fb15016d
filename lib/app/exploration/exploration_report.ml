open Dolphin_semantics
module Safe_print = Dolphin_display.Safe_print
module Search = Dolphin_explore.Search
module Property = Dolphin_explore.Property

let mebibytes bytes = bytes / 1024 / 1024

(* {1 For people} *)

(* The faults that violate [property] too, at other places of the text than that of the run that is shown. *)
let other_faults (o : Search.outcome) property (run : Search.run) =
  let shown (f : Fault.t) =
    match List.rev run.steps with
    | { next = { control = Ended (Failed fault); _ }; _ } :: _ -> fault.site = f.site
    | _ -> false
  in
  List.filter (fun f -> not (shown f)) (Option.value (List.assoc_opt property o.ending_faults) ~default:[])

let most_others = 10

let print_others program o (property, (verdict : Search.verdict), remark) =
  match verdict with
  | Violated run when not remark ->
    let others = other_faults o property run in
    let print i (f : Fault.t) =
      if i < most_others then
        match Fault.location program f with
        | Some at -> Safe_print.format "  also at %a: %s@." Dolphin_syntax.Location.pp at f.message
        | None -> Safe_print.format "  also: %s@." f.message
    in
    List.iteri print others;
    let more = List.length others - most_others in
    if more > 0 then Safe_print.printf "  and at %d more places\n" more
  | Violated _ | Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _ -> ()

let print_verdict program (o : Search.outcome) (property, (verdict : Search.verdict), remark) =
  match verdict with
  | (Holds | Holds_if _ | Inconclusive _) when remark -> ()
  (* The verdict on tasks stands for both, unless vehicles are missing. *)
  | (Holds | Holds_if _ | Inconclusive _) when property = Property.Vehicles -> ()
  | Holds | Holds_if _ | Violated _ | By_design _ | Unreached _ | Inconclusive _ ->
    let pp = Search.pp_verdict ~fairness:o.fairness program in
    Safe_print.format "%s%a@." (if remark then "note: " else "") pp (property, verdict)

let print_counts (o : Search.outcome) =
  let reduced =
    match Search.reductions o with
    | [] -> ""
    | names -> "; reduced by " ^ String.concat ", " names
  in
  let for_formulas = if o.formula_states = 0 then "" else Printf.sprintf "; %d states for formulas" o.formula_states in
  let for_pairs =
    if o.beside_states = 0 then "" else Printf.sprintf "; %d states for plans side by side" o.beside_states in
  Safe_print.printf "%d states, %d transitions, depth %d, %.2f s, %d MiB%s%s%s\n" o.states o.transitions o.depth
    o.seconds (mebibytes o.bytes) reduced for_formulas for_pairs

let percent share = Printf.sprintf "%.3g%%" (100. *. share)

let print_sample (s : Dolphin_checker.Sample.summary) ~seen =
  let walks = if s.walks = 1 then "walk" else "walks" in
  Safe_print.printf "%d random %s (--seed %d): %d visits to %d states\n" s.walks walks s.seed s.steps s.visited;
  if s.visited < seen then
    Safe_print.printf "estimated: the next visit is to a new state with a chance of %s; about %.0f states or more\n"
      (percent s.unvisited) s.states

let print_bitstate (s : Dolphin_checker.Bitstate.summary) =
  Safe_print.printf "bitstate: %d hashes a state in %d bytes, %s of the bits are set\n" Dolphin_checker.Bitstate.hashes
    s.bytes (percent s.filled);
  let omitted = Printf.sprintf (if s.omitted >= 10. then "%.0f" else "%.2g") s.omitted in
  Safe_print.printf "expected: %s states left out of those it came to; any at all with a chance of %s\n" omitted
    (percent s.omission)

(* The call for which the fleet has no reply, if the run ends with one. *)
let unanswered (run : Search.run) =
  match List.rev run.steps with
  | { label = No_reply why; _ } :: { label = Call call; _ } :: _
    when why = Dolphin_environment.Environment.no_reply call -> Some call
  | _ -> None

let print_run program property (run : Search.run) =
  print_newline ();
  Run_columns.say
    (Printf.sprintf "%s: a%s run%s in which %s" (Property.name property)
       (if run.shortest then " shortest" else "")
       (Option.fold run.faults ~none:"" ~some:(fun faults -> " " ^ Search.faults_text faults))
       (Property.question property));
  Run_columns.print ?decided:run.decided program ~steps:run.steps ~cycle:run.cycle;
  if property = Property.No_deadlock then Run_columns.print_waiting program run.steps;
  let tell call =
    Safe_print.format "the fleet lacks an entry: reply %a, and the supplier's possible replies@." Value.pp
      (String call) in
  Option.iter tell (unanswered run)

let print_unreached (program : Core.program) property pieces =
  Safe_print.format "@.%s: no run reaches@." (Property.name property);
  List.iter
    (fun (piece : Dolphin_explore.Coverage.piece) ->
       Safe_print.format "  %a: %s@." Dolphin_syntax.Location.pp program.locations.(piece.site) piece.what)
    pieces

let print_violation (program : Program_file.t) (property, (verdict : Search.verdict), remark) =
  match verdict with
  | Violated run when not remark -> print_run program property run
  | Unreached pieces when not remark -> print_unreached program.program property pieces
  | Holds | Holds_if _ | By_design _ | Inconclusive _ | Violated _ | Unreached _ -> ()

let with_remarks ~strict (o : Search.outcome) =
  let with_remark (property, verdict) = (property, verdict, Exploration.is_remark property && not strict) in
  List.map with_remark o.verdicts

let print_violations ~strict program o = List.iter (print_violation program) (with_remarks ~strict o)

let print ?from ~strict (program : Program_file.t) (o : Search.outcome) =
  let verdicts = with_remarks ~strict o in
  Option.iter (Safe_print.format "%a@." Present.pp) from;
  let print_one verdict =
    print_verdict program.program o verdict;
    print_others program.program o verdict
  in
  List.iter print_one verdicts;
  print_counts o;
  Option.iter (print_sample ~seen:o.states) o.sample;
  Option.iter print_bitstate o.bitstate;
  Beside_report.print program o.beside;
  List.iter (print_violation program) verdicts

(* {1 For programs} *)

let recurring name needs =
  let one readings = `String (Format.asprintf "%a" Dolphin_explore.Looks.pp_readings readings) in
  (name, `List (List.map one needs))

let json_of_run (run : Search.run) =
  let labels steps =
    `List
      (List.map
         (fun (t : Transition.t) ->
            `String (Format.asprintf "%a" Label.pp t.label))
         steps)
  in
  let assumed i (t : Transition.t) =
    let what a = `String (Format.asprintf "%a" World.pp_assumption a) in
    if t.assumed = [] then None
    else Some (`Assoc [ ("step", `Int (i + 1)); ("assumed", `List (List.map what t.assumed)) ])
  in
  let helpful =
    match run.helpful with
    | None -> []
    | Some { recurring = readings; strong } ->
      (if readings = [] then [] else [ recurring "holds if these recur" readings ])
      @ if strong then [ ("holds with strong fairness", `Bool true) ] else []
  in
  let faults { Search.number; fewest } = [ ("faults", `Int number); ("fewest_faults", `Bool fewest) ] in
  let assumptions = List.filter_map Fun.id (List.mapi assumed (run.steps @ run.cycle)) in
  [ ("shortest", `Bool run.shortest); ("run", labels run.steps); ("cycle", labels run.cycle) ]
  @ Option.fold run.decided ~none:[] ~some:(fun n -> [ ("decided", `Int n) ])
  @ Option.fold run.faults ~none:[] ~some:faults
  @ helpful
  @ if assumptions = [] then [] else [ ("assumptions", `List assumptions) ]

let fairness (o : Search.outcome) property =
  match o.fairness with
  | Strong when Property.is_of_fair_runs property -> [ ("fairness", `String "strong") ]
  | Weak | Strong | No_fairness -> []

let to_json ?from (p : Program_file.t) (o : Search.outcome) : Yojson.Safe.t =
  let program = p.program in
  let also property run =
    let fault (f : Fault.t) =
      let at = Option.map (Format.asprintf "%a" Dolphin_syntax.Location.pp) (Fault.location program f) in
      `Assoc (Option.fold at ~none:[] ~some:(fun at -> [ ("at", `String at) ]) @ [ ("fault", `String f.message) ])
    in
    match other_faults o property run with [] -> [] | others -> [ ("also", `List (List.map fault others)) ]
  in
  let verdict (property, verdict) =
    let name = `String (Property.name property) in
    let result, more =
      match (verdict : Search.verdict) with
      | Holds -> ("holds", [])
      | Holds_if needs -> ("holds", [ recurring "assuming" needs ])
      | Violated run -> ("violated", json_of_run run @ also property run)
      | By_design { repeats; retries; left_by; needs } ->
        let at site = `String (Format.asprintf "%a" Dolphin_syntax.Location.pp program.locations.(site)) in
        let what = List.map (fun text -> `String text) left_by in
        let sites name found = (name, `List (List.map at found)) in
        ("by design not", [ sites "repeats" repeats; sites "retries" retries; ("ended by", `List what) ]
                          @ if needs = [] then [] else [ recurring "assuming" needs ])
      | Unreached pieces ->
        let piece (p : Dolphin_explore.Coverage.piece) =
          let at = Format.asprintf "%a" Dolphin_syntax.Location.pp program.locations.(p.site) in
          `Assoc [ ("at", `String at); ("what", `String p.what) ]
        in
        ("violated", [ ("unreached", `List (List.map piece pieces)) ])
      | Inconclusive bound ->
        ("inconclusive", [ ("bound", `String (Format.asprintf "%a" Dolphin_checker.Limits.pp_bound bound)) ])
    in
    let pairs =
      match (property : Property.t) with
      | Apart _ -> [ ("states", `Int o.beside_states); ("pairs", Beside_report.json p o.beside) ]
      | No_deadlock | Termination | No_error | Assertions | Vehicles | Allocation | No_halt | No_leftover | All_reached
      | Invariant _ | Formula _ -> []
    in
    `Assoc ([ ("property", name); ("verdict", `String result) ] @ fairness o property @ more @ pairs)
  in
  let sample (s : Dolphin_checker.Sample.summary) =
    `Assoc
      [ ("walks", `Int s.walks); ("seed", `Int s.seed); ("visits", `Int s.steps); ("visited", `Int s.visited);
        ("new", `Float s.unvisited); ("estimate", `Float s.states) ]
  in
  let samples = Option.fold ~none:[] ~some:(fun s -> [ ("sample", sample s) ]) o.sample in
  let bitstate (s : Dolphin_checker.Bitstate.summary) =
    `Assoc
      [ ("bytes", `Int s.bytes); ("hashes", `Int Dolphin_checker.Bitstate.hashes); ("filled", `Float s.filled);
        ("omitted", `Float s.omitted); ("omission", `Float s.omission) ]
  in
  let bits = Option.fold ~none:[] ~some:(fun s -> [ ("bitstate", bitstate s) ]) o.bitstate in
  `Assoc
    ([ ("states", `Int o.states); ("transitions", `Int o.transitions); ("depth", `Int o.depth);
       ("seconds", `Float o.seconds); ("bytes", `Int o.bytes); ("formula_states", `Int o.formula_states);
       ("reductions", `List (List.map (fun name -> `String name) (Search.reductions o)));
       ("verdicts", `List (List.map verdict o.verdicts)) ]
     @ samples @ bits @ Option.fold from ~none:[] ~some:(fun present -> [ ("from", Present.to_json present) ]))
