open Dolphin_semantics
open Dolphin_time
module Timed_analysis = Dolphin_time.Timed_analysis
module Safe_print = Dolphin_display.Safe_print
module Columns = Dolphin_display.Columns
module Text_table = Dolphin_display.Text_table

let say format = Printf.ksprintf Run_columns.say format

let bound_text bound = Format.asprintf "%a" Dolphin_checker.Limits.pp_bound bound
let time ms = Format.asprintf "%a" Bounds.pp_time ms

(* {1 Names} *)

let moments : Timed_system.moment list = [ Starts; Ends; Fails; Stopped ]

(* A date of code. Those of times of day come again each day. *)
let date (p : Program_file.t) k =
  match Dated_code.named p.program, p.program.begins with
  | Ok { once; daily = _ :: _ }, Some begins when not (List.mem k once) ->
    Format.asprintf "timeOfDay() = %a" Calendar.pp_time (Calendar.at begins k)
  | _, _ -> "now() = " ^ Dolphin_trace.Phrase.time (float_of_int k)

(* The awaited events, and the party that defines their durations. *)
let item ?at (p : Program_file.t) (pending : Clocked.pending) =
  let place = Option.fold (Option.bind at (Program_file.at p)) ~none:"" ~some:(fun at -> at ^ ": ") in
  match pending.item, pending.task with
  | Task v, Some task ->
    let place = match Program_file.at p task.task_site with Some place -> place ^ ": " | None -> "" in
    Printf.sprintf "%s%s on %s" place task.name v
  | Task v, None -> v
  | Timer 0, _ -> place ^ "a timer of the program"
  | Timer i, _ -> if place = "" then Printf.sprintf "timer %d" i else place ^ "a timer"
  | (Question _ | Answer), _ ->
    "an answer" ^ Option.fold pending.prompt ~none:"" ~some:(fun prompt -> Printf.sprintf " to '%s'" prompt)
  | Recruit _, _ -> "a vehicle to recruit"
  | Reply, _ -> "a reply"
  | Posting k, _ -> Printf.sprintf "a pair with the key %s" k
  | Links, _ -> Option.value pending.prompt ~default:"a link"
  | Silence v, _ -> "nothing is heard of " ^ v
  | Course v, _ -> "the battery of " ^ v
  | Date k, _ -> date p k

let hint (pending : Clocked.pending) =
  match pending.item, pending.task with
  | Task _, Some { plan = None; name; _ } -> Printf.sprintf "; in the fleet: plan '%s', { duration 3.min, 9.min }" name
  | Task _, Some { plan = Some _; _ } -> "; the vehicle's position at its start is unknown"
  | Posting k, _ -> Printf.sprintf "; in the fleet: input '%s', with after" k
  | (Task _ | Timer _ | Question _ | Recruit _ | Answer | Reply | Links | Silence _ | Course _ | Date _), _ -> ""

(* {1 For people} *)

let window (w : Timed_analysis.window) =
  match w.latest with
  | At latest when latest = w.earliest -> time latest
  | At latest -> Printf.sprintf "%s to %s" (time w.earliest) (time latest)
  | Unbounded -> Printf.sprintf "%s or later" (time w.earliest)

let print_ending (e, (w : Timed_analysis.window)) =
  let latest = match w.latest with At n -> time n ^ " at the latest" | Unbounded -> "no latest time" in
  say "%s: %s at the earliest, %s" (Timed_system.ending_name e) (time w.earliest) latest

let slack : Slack.t option -> string = function Some Any -> "any" | Some (By ms) -> time ms | None -> "unknown"

(* Times of [slacks] are by how much longer a task may take before the latest end is later. *)
let print_tasks ?slacks (p : Program_file.t) (o : Timed_analysis.outcome) =
  let used = List.filter (fun m -> List.exists (fun (_, ws) -> List.mem_assoc m ws) o.tasks) moments in
  let row ((task : Timed_analysis.task), windows) =
    let cell m = Option.fold ~none:"" ~some:window (List.assoc_opt m windows) in
    let of_task (s : Timed_analysis.slacks) = [ slack (List.assoc_opt task s.known) ] in
    let slack = Option.fold slacks ~none:[] ~some:of_task in
    (task.name :: task.vehicle :: List.map cell used) @ slack @ [ Program_file.line p task.site ]
  in
  let slack = if slacks = None then [] else [ "slack" ] in
  if o.tasks <> [] then
    List.iter Safe_print.line
      (Text_table.lines ?columns:(Run_columns.columns ())
         (("task" :: "vehicle" :: List.map Timed_system.moment_name used) @ slack @ [ "where" ])
         (List.map row o.tasks))

let print_columns (p : Program_file.t) (run : Timed_analysis.run) =
  let heads = if run.dates = [] then None else Some (List.map time run.dates) in
  let columns = Run_columns.columns () in
  let lines ?first ?heads ?before steps =
    List.iter Safe_print.line (Columns.lines ?first ?heads ?columns ?before ~source:p.source p.program steps)
  in
  lines ?heads run.steps;
  if run.cycle <> [] then begin
    Safe_print.line "and from there, again and again:";
    let before = List.fold_left (fun _ (t : Transition.t) -> Some t.next) None run.steps in
    lines ~first:(List.length run.steps + 1) ?before run.cycle
  end

let print_chain p (run : Timed_analysis.run) =
  let link (l : Schedule.link) = Printf.sprintf "%s (%s)" (item ?at:l.at p l.pending) (time l.lasts) in
  if run.chain <> [] then
    say "its end depends on: %s" (String.concat ", then " (List.map link run.chain))

(* The cycle of a run: endless [repeat]s of a task, or the script. *)
let goes_round p (run : Timed_analysis.run) =
  let is_round (t : Transition.t) =
    List.exists (fun (r : Rule.t) -> match r with Repeat_2 | Repeat_again -> true | _ -> false) t.rules in
  let endless found : Residual.t -> _ = function
    | Repeat { again = { left = None; site; _ }; _ } -> site :: found
    | _ -> found
  in
  let repeats (t : Transition.t) =
    match t.next.control with
    | Executing (_, r) when is_round t -> Residual.fold_active endless [] r
    | Executing _ | Script _ | Waiting _ | Ended _ -> []
  in
  let script (t : Transition.t) =
    match t.next.control with Script _ | Waiting _ -> [ Configuration.site t.next ] | Executing _ | Ended _ -> [] in
  let places sites = List.sort_uniq String.compare (List.filter_map (Program_file.at p) sites) in
  match places (List.concat_map repeats run.cycle), places (List.concat_map script run.cycle) with
  | [], [] -> None
  | [], place :: _ -> Some ("the script at " ^ place)
  | repeats, _ -> Some ("the repeat at " ^ String.concat ", or at " repeats)

let missed (o : Timed_analysis.outcome) = List.find_map (fun (_, missed) -> Option.map snd missed) o.deadlines

type shown = Endless of [ `Cycle | `In_no_time | `Stuck ] | Late | Missed | Empty of string | Last

let empty (o : Timed_analysis.outcome) =
  let run_of (b : Timed_analysis.battery) =
    match b.lowest with
    | Some (_, run) when Timed_analysis.runs_empty b -> Some (Empty b.vehicle, run)
    | Some _ | None -> None in
  List.find_map run_of o.batteries

let shown (o : Timed_analysis.outcome) =
  match o.endless, o.late, missed o, empty o, o.last with
  | Some (run, why), _, _, _, _ -> Some (Endless why, run)
  | None, Some run, _, _, _ -> Some (Late, run)
  | None, None, Some run, _, _ -> Some (Missed, run)
  | None, None, None, Some found, _ -> Some found
  | None, None, None, None, Some ({ dates = _ :: _; _ } as run) when o.stopped = None -> Some (Last, run)
  | None, None, None, None, (Some _ | None) -> None

let what ?deadline = function
  | Endless `Cycle -> "a run that may never end"
  | Endless `In_no_time -> "a run that may loop endlessly in no time"
  | Endless `Stuck -> "a run in which nothing more happens"
  | Late ->
    "a run that is not over at the deadline" ^ Option.fold ~none:"" ~some:(fun n -> ", " ^ time n) deadline
  | Missed -> "a run in which a task is not done within its time"
  | Empty v -> Printf.sprintf "a run in which the battery of %s runs empty" v
  | Last -> "a run that ends last"

(* In the words of properties. *)
let breaks ?deadline = function
  | Endless _ -> "every run ends"
  | Late -> "deadline" ^ Option.fold ~none:"" ~some:(fun n -> " " ^ time n) deadline
  | Missed -> "within"
  | Empty v -> "battery of " ^ v
  | Last -> ""

let print_run ?deadline p (o : Timed_analysis.outcome) =
  let print (why, (run : Timed_analysis.run)) =
    Safe_print.printf "\n%s:\n" (what ?deadline why);
    print_columns p run;
    match why with
    | Endless `Stuck -> Run_columns.print_waiting p run.steps
    | Late | Last -> print_chain p run
    | Endless (`Cycle | `In_no_time) -> Option.iter (say "it goes round in %s") (goes_round p run)
    | Missed | Empty _ -> ()
  in
  Option.iter print (shown o)

let write_shown ?deadline program fleet path o =
  let write (why, (run : Timed_analysis.run)) =
    Witness_file.write program fleet path
      { breaks = breaks ?deadline why; description = what ?deadline why; steps = run.steps; cycle = run.cycle }
  in
  Option.fold (shown o) ~none:(Ok ()) ~some:write

let print_failing p run =
  Safe_print.line "\na run that fails:";
  print_columns p run

let print_deadline ?deadline (o : Timed_analysis.outcome) =
  let say n =
    let verdict = Timed_analysis.in_time ~deadline:n o in
    Safe_print.printf "deadline %s: %s\n" (time n) (Dolphin_checker.Verdict.name verdict) in
  Option.iter say deadline

let print_within p (o : Timed_analysis.outcome) (site, missed) =
  let verdict =
    match missed with
    | Some (w, _) -> "missed, at " ^ window w
    | None when o.stopped = None -> "kept"
    | None -> "inconclusive"
  in
  say "%s: within: %s" (Option.value (Program_file.at p site) ~default:"") verdict

(* Each once, though the program may start it again and again. *)
let print_unknown p (o : Timed_analysis.outcome) =
  let add found u =
    let line = item p u ^ hint u in
    if List.mem line found then found else line :: found
  in
  List.iter (say "duration unknown: %s") (List.rev (List.fold_left add [] o.unknown))

(* To a tenth of a percent, rounded down: never more than there is. *)
let share x = Printf.sprintf "%g %%" (Float.floor ((x *. 1000.) +. 1e-6) /. 10.)

(* A bound without a known run is marked as one. *)
let battery (b : Timed_analysis.battery) =
  match b.lowest with
  | _ when Timed_analysis.runs_empty b -> "runs empty"
  | Some (lowest, _) when share lowest = share b.least -> share b.least
  | Some (lowest, _) when Timed_analysis.may_run_empty b -> Printf.sprintf "unknown; %s in some run" (share lowest)
  | Some (lowest, _) -> Printf.sprintf "%s or more; %s in some run" (share b.least) (share lowest)
  | None when Timed_analysis.may_run_empty b -> "unknown"
  | None -> share b.least ^ " or more"

let print_batteries (o : Timed_analysis.outcome) =
  let row (b : Timed_analysis.battery) = [ b.vehicle; battery b ] in
  let heads = [ "vehicle"; "least battery" ] in
  if o.batteries <> [] then
    List.iter Safe_print.line (Text_table.lines ?columns:(Run_columns.columns ()) heads (List.map row o.batteries))

let print_apart (a : Timed_analysis.apart) =
  let verdict = Timed_analysis.judge_apart a in
  let why =
    match verdict, a.cut_short with
    | Violated, _ -> ": plans run side by side whose ways come nearer to each other"
    | Inconclusive, Some bound -> ", " ^ bound_text bound
    | Inconclusive, None -> ", plans run side by side at an unknown distance"
    | Holds, _ -> ""
  in
  say "%s: %s%s" a.fence (Dolphin_checker.Verdict.name verdict) why

let print_slacks (s : Timed_analysis.slacks) =
  let print bound = say "slack: inconclusive: %s" (bound_text bound) in
  Option.iter print s.cut_short

let print ?from ?deadline ?slacks p (o : Timed_analysis.outcome) =
  Option.iter (Safe_print.format "%a@." Present.pp) from;
  (match o.stopped with
   | Some bound -> say "inconclusive: %s; times are of the runs until then" (bound_text bound)
   | None -> ());
  List.iter print_ending o.endings;
  if o.endings = [] && o.stopped = None then Safe_print.line "no run ends";
  print_deadline ?deadline o;
  List.iter (print_within p o) o.deadlines;
  Option.iter print_apart o.apart;
  print_unknown p o;
  print_tasks ?slacks p o;
  Option.iter print_slacks slacks;
  print_batteries o;
  Safe_print.printf "%d states, depth %d, %.2f s, %d MiB\n" o.states o.depth o.seconds (o.bytes / 1024 / 1024);
  Option.iter (fun (a : Timed_analysis.apart) -> Beside_report.print p a.pairs) o.apart;
  print_run ?deadline p o

(* {1 For programs} *)

let seconds ms : Yojson.Safe.t = if ms mod 1000 = 0 then `Int (ms / 1000) else `Float (float ms /. 1000.)

let json_of_window (w : Timed_analysis.window) : Yojson.Safe.t =
  let latest = match w.latest with At n -> seconds n | Unbounded -> `Null in
  `Assoc [ ("earliest", seconds w.earliest); ("latest", latest) ]

let json_of_run p (run : Timed_analysis.run) : Yojson.Safe.t =
  let label (t : Transition.t) = `String (Format.asprintf "%a" Label.pp t.label) in
  let link (l : Schedule.link) =
    `Assoc [ ("what", `String (item ?at:l.at p l.pending)); ("seconds", seconds l.lasts) ] in
  `Assoc
    [ ("run", `List (List.map label run.steps)); ("dates", `List (List.map seconds run.dates));
      ("cycle", `List (List.map label run.cycle)); ("chain", `List (List.map link run.chain)) ]

let json_of_slack : Slack.t option -> (string * Yojson.Safe.t) list = function
  | Some Any -> [ ("slack", `String "any") ]
  | Some (By ms) -> [ ("slack", seconds ms) ]
  | None -> []

let json_of_battery p (b : Timed_analysis.battery) : Yojson.Safe.t =
  let lowest (share, run) = [ ("lowest", `Float share); ("run", json_of_run p run) ] in
  let verdict =
    if Timed_analysis.runs_empty b then "violated"
    else if Timed_analysis.may_run_empty b then "inconclusive"
    else "holds" in
  `Assoc
    ([ ("vehicle", `String b.vehicle); ("verdict", `String verdict); ("least", `Float b.least) ]
     @ Option.fold b.lowest ~none:[] ~some:lowest)

let json_of_apart p (a : Timed_analysis.apart) : Yojson.Safe.t =
  let bound b = ("bound", `String (bound_text b)) in
  `Assoc
    ([ ("fence", `String a.fence); ("verdict", `String (Dolphin_checker.Verdict.name (Timed_analysis.judge_apart a)));
       ("pairs", Beside_report.json p a.pairs) ]
     @ Option.to_list (Option.map bound a.cut_short))

let to_json ?from ?deadline ?slacks p (o : Timed_analysis.outcome) : Yojson.Safe.t =
  let none = { Timed_analysis.known = []; cut_short = None } in
  let { Timed_analysis.known; cut_short } = Option.value slacks ~default:none in
  let task ((t : Timed_analysis.task), windows) =
    let window m = Option.map (fun w -> (Timed_system.moment_name m, json_of_window w)) (List.assoc_opt m windows) in
    let site = Option.fold ~none:`Null ~some:(fun s -> `String s) (Program_file.at p t.site) in
    `Assoc
      ([ ("task", `String t.name); ("vehicle", `String t.vehicle); ("at", site) ]
       @ List.filter_map window moments @ json_of_slack (List.assoc_opt t known))
  in
  let within (site, missed) =
    let place = Option.fold ~none:`Null ~some:(fun s -> `String s) (Program_file.at p site) in
    let missed =
      match missed with
      | Some (w, run) -> [ ("missed", json_of_window w); ("run", json_of_run p run) ]
      | None -> [ ("missed", `Null) ]
    in
    `Assoc (("at", place) :: missed)
  in
  let optional name f x = match x with Some x -> [ (name, f x) ] | None -> [] in
  let bound b : Yojson.Safe.t = `String (bound_text b) in
  let verdict = Dolphin_checker.Verdict.name (Timed_analysis.verdict ?deadline o) in
  let endless (run, why) : Yojson.Safe.t =
    let why = match why with `Cycle -> "cycle" | `In_no_time -> "cycle in no time" | `Stuck -> "stuck" in
    let round = Option.to_list (Option.map (fun place -> ("round", `String place)) (goes_round p run)) in
    `Assoc ([ ("why", `String why) ] @ round @ [ ("run", json_of_run p run) ])
  in
  let json_of_shown (why, run) : Yojson.Safe.t =
    `Assoc [ ("what", `String (what ?deadline why)); ("run", json_of_run p run) ] in
  `Assoc
    ([ ("verdict", `String verdict) ]
     @ optional "deadline" seconds deadline
     @ [ ("inTime", `String (Dolphin_checker.Verdict.name (Timed_analysis.in_time ?deadline o))) ]
     @ [ ("ends", `Assoc (List.map (fun (e, w) -> (Timed_system.ending_name e, json_of_window w)) o.endings));
         ("tasks", `List (List.map task o.tasks));
         ("within", `List (List.map within o.deadlines));
         ("batteries", `List (List.map (json_of_battery p) o.batteries));
         ("unknown", `List (List.map (fun u -> `String (item p u)) o.unknown)) ]
     @ optional "apart" (json_of_apart p) o.apart
     @ optional "last" (json_of_run p) o.last
     @ optional "first" (json_of_run p) o.first
     @ optional "endless" endless o.endless
     @ optional "shown" json_of_shown (shown o)
     @ optional "bound" bound o.stopped @ optional "slackBound" bound cut_short
     @ optional "from" Present.to_json from
     @ [ ("states", `Int o.states); ("depth", `Int o.depth); ("seconds", `Float o.seconds); ("bytes", `Int o.bytes) ])
