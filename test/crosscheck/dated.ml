open Dolphin_semantics
open Dolphin_tlc
open Dolphin_time
module Scenario = Dolphin_scenario.Scenario
module Faults = Dolphin_environment.Faults

type t = { case : Case.t; durations : Durations.t; plans : string list }

(* {1 Programs} *)

(* Durations in seconds, by the name of the plan and the vehicle: some exact, some zero, some overlapping. A plan of
   another name takes the same on each vehicle. *)
let hashed seed plans : Durations.t =
  let task v _ (p : Core.platform_task) =
    let n = if List.mem p.name plans then Hashtbl.hash (seed, v, p.name) else seed in
    let least = n mod 3 in
    Bounds.Within { least = 1000 * least; most = 1000 * (least + (n / 3 mod 3)) }
  in
  let posted key = if key = "y" then Bounds.exactly 2. else Bounds.between 1. 2. in
  let links =
    Links.of_silences
      (match seed mod 6 with
       | 0 -> [ ("a", [ (1., 4.) ]); ("b", [ (0., 1.); (2., 3.) ]) ]
       | 1 -> [ ("a", [ (2., infinity) ]); ("c", [ (0., 2.); (4., 5.) ]) ]
       | _ -> [])
  in
  { task; announced = Bounds.exactly 1.; silence = Bounds.exactly 2.; posted; place = (fun _ -> None); links;
    charges = (fun _ -> None); has_chargers = (fun _ -> false) }

(* spec/Timed.tla knows the durations of named plans only. *)
let describes_plans (case : Case.t) =
  match Str.search_forward (Str.regexp_string "imcPlan") case.source 0 with
  | _ -> true
  | exception Not_found -> false

let random ~seed n =
  let plans = [ "p"; "q" ] in
  let one i case = { case; durations = hashed (seed + i) plans; plans } in
  let is_timed { case; _ } = not (describes_plans case) in
  List.filter is_timed (List.mapi one (Case.random ~seed n))

(* {2 With fleets} *)

let in_fleet (case, scenario) =
  { case; durations = Durations.of_scenario scenario;
    plans = List.map (fun (p : Scenario.plan) -> p.name) scenario.plans }

let no_fault = ("", Faults.none)
let a_loss = (", with a loss", { Faults.none with loss = At_most 1 })

let a_failure = (", with a failure", { Faults.none with fail = At_most 1 })
let examples directory = List.map in_fleet (Case.with_fleets [ no_fault; a_failure ] directory)

let read text =
  match Scenario.read ~file:"small.fleet" text with
  | Ok scenario -> scenario
  | Error ds -> failwith (Format.asprintf "%a" (Fmt.list (Dolphin_syntax.Diagnostic.pp ~source:text)) ds)

let scenario =
  read
    "vehicle 'a', { type 'UUV' }\nvehicle 'b', { type 'UUV' }\nvehicle 'c', { type 'UAV' }\n\
     plan 'p', { duration 2, 4 }\nplan 'q', { duration 3 }\nplan 'r', { duration 1, 2; mayFail 0.5 }\n\
     answer 'go on?', 'yes'\ninput 'x', 1, after 5\n"

let linked =
  read
    "vehicle 'a', { type 'UUV'; drops 2, 3; drops 9, 2 }\nvehicle 'b', { type 'UUV'; joins 4; leaves 12 }\n\
     vehicle 'c', { type 'UAV'; drops 1, 20 }\n\
     plan 'p', { duration 2, 4 }\nplan 'q', { duration 3 }\nplan 'r', { duration 1, 2; mayFail 0.5 }\n"

let two = "a = pick { id 'a' }; b = pick { id 'b' }\n"

let texts =
  [ ("one after the other", no_fault, two ^ "execute task('p')[a] >> idle(2) >> task('q')[b]");
    ("side by side", no_fault, two ^ "execute task('p')[a] | task('q')[b] | idle(1)");
    ("a time that ends a task", no_fault, two ^ "execute task('p')[a] during 3");
    ("a time that a task may miss", no_fault, two ^ "execute task('p')[a] within 3");
    ("a time that a task keeps, on the stroke", no_fault, two ^ "execute task('p')[a] within 4");
    ("times inside of times", no_fault, two ^ "execute ((task('p')[a] >> idle(1)) during 4) >> (task('q')[b] during { 1 + 1 })");
    ( "a task that ends another one", no_fault,
      two ^ "execute (task('p')[a] >> action { post x: 1 }) | ((task('q')[b] >> task('q')[b]) until { consume x: 1 })" );
    ( "whose turn it is", no_fault,
      two ^ "c = pick { id 'c' }\n\
             execute (task('p')[a] >> action { post x: 1 }) | (task('r')[b] >> action { post y: 1 })\n\
             | allOf { when { consume x: 1 } then task('q')[c]\n when { consume y: 1 } then task('p')[c] }" );
    ("rounds", no_fault, two ^ "execute repeat 3, task('p')[a] >> idle(1)");
    ("rounds of nothing but a timer", no_fault, two ^ "execute (repeat 3, idle(2)) | task('p')[a]");
    ("a pause", no_fault, two ^ "pause 2\nexecute task('q')[a]");
    ("whoever is there", no_fault, "vs = pick { count _; timeout 3 }\nexecute task('q')");
    ("too few", no_fault, "v = pick { type 'USV'; timeout 4 }\nexecute task('q')[v]");
    ("a task that may fail", no_fault, two ^ "execute watch (task('r')[a] | task('p')[b]) onError { ignore() }");
    ("a posted pair", no_fault, "input 'x'\n" ^ two ^ "execute waitFor { consume x: _ } then task('p')[a]");
    ( "a look at once", no_fault,
      two ^ "execute until { battery(a) < 0.5 } run (action { halt 'h' } | task('p')[b])\nexecute task('q')[a]" );
    ( "a date", no_fault,
      two ^ "execute task('p')[a] | (waitFor { now() >= 3 } then task('q')[b])\n\
             if (now() < 6) { execute task('p')[a] }" );
    ( "a date that has passed", no_fault,
      two ^ "pause 2\nexecute waitFor { now() >= 1 } then task('q')[a]\n\
             execute { now() == 5 ? task('p') : task('q') }[b]" );
    ( "a date that ends a task, on the stroke", no_fault,
      two ^ "limit = 4\nexecute (task('p')[a] until { now() >= limit }) | (idle(4) >> watch (assure { now() <= limit } \
             run task('q')[b]) onError { ignore() })" );
    ("a loop to a date", no_fault, two ^ "while (now() < 5) { pause 2 }\nexecute task('q')[a]");
    ("the latest patience", a_loss, "setConnectionTimeout 5\nsetConnectionTimeout 6\n" ^ two ^ "execute task('p')[a]");
    ( "the order to a vehicle that is lost", a_loss,
      two ^ "setConnectionTimeout a, 5\nexecute (watch task('p')[a] onError { ignore() }) >> task('q')[a]" );
    ( "one link is lost, and not the other", a_loss,
      two ^ "c = pick { id 'c' }; setConnectionTimeout 5\n\
             execute (task('p')[a] >> action { post x: 1 }) | (((watch task('q')[b] onError { ignore() })\n\
             >> idle(0) >> task('r')[c]) until { poll x: 1 })" );
    ( "a latecomer", (", with latecomers", { Faults.none with join = Any_number }),
      "vs = pick { count 2; type 'UUV'; timeout 3 }\nexecute task('r')[vs[0]] >> task('q')[vs[1]]" );
    ( "at any time somebody leaves", (", with interruptions", { Faults.none with interrupt = true }),
      "onInterrupt { v -> task('q')[v] }\n" ^ two ^ "execute task('p')[a]" ) ]

let soon = "setConnectionTimeout 5\n"

let linked_texts =
  let a = soon ^ "a = pick { id 'a' }\n" in
  [ ("an order that waits for the link", no_fault, a ^ "pause 3\nexecute task('p')[a]");
    ("what ends unheard is told late", no_fault, a ^ "execute task('p')[a] >> task('r')[a]");
    ("a link that is back again and again", no_fault, a ^ "execute watch (repeat 4, task('r')[a]) onError { ignore() }");
    ("a silent link", no_fault, soon ^ "c = pick { id 'c' }\nexecute watch task('p')[c] onError { task('q') }");
    ("an order that is given up", no_fault, soon ^ "c = pick { id 'c' }\npause 2\nexecute task('p')[c]");
    ("who joins", no_fault, soon ^ "v = pick { id 'b'; timeout 6 }\nexecute task('q')[v]");
    ("who joins on the stroke", no_fault, soon ^ "v = pick { id 'b'; timeout 4 }\nexecute task('q')[v]");
    ("who leaves", no_fault, soon ^ "v = pick { id 'b'; timeout 6 }\nexecute repeat 3, task('q')[v]");
    ("whoever is heard of", no_fault, soon ^ "vs = pick { count _; timeout 5 }\nexecute task('q')[vs[0]]");
    ("who joins is recruited", no_fault, soon ^ "execute recruit { type 'UUV' } then { v -> task('q') } | idle(3)");
    ("a silent one is recruited", no_fault, soon ^ "pause 3\nexecute recruit { id 'a' } then { v -> task('p') }");
    ("a silent one fails", a_failure, a ^ "execute watch task('p')[a] onError { ignore() }");
    ("who joins, and who is lost", a_loss, soon ^ "v = pick { id 'b'; timeout 6 }\nexecute task('p')[v]") ]

let small =
  let case scenario (name, (kind, faults), source) =
    in_fleet (Case.in_fleet (name ^ kind) source scenario faults, scenario) in
  List.map (case scenario) texts @ List.map (case linked) linked_texts

(* {1 The results of dolphin time} *)

type prepared = {
  name : string;
  source : string;
  expected : (string list * (int * int)) list;  (* in ticks, in ascending order *)
  constants : Family.constant list;
}

exception Unfit

let in_ticks tick ms = if ms mod tick = 0 then ms / tick else raise_notrace Unfit

let window ~tick ~ticks (w : Timed_analysis.window) =
  match w.latest with
  | At latest when latest <= ticks * tick -> (in_ticks tick w.earliest, in_ticks tick latest)
  | At _ | Unbounded -> raise_notrace Unfit

let moments ~tick ~ticks (program : Core.program) (o : Timed_analysis.outcome) =
  let place site =
    if site >= 0 && site < Array.length program.locations then
      Format.asprintf "%a" Dolphin_syntax.Location.pp program.locations.(site)
    else ""
  in
  let window = window ~tick ~ticks in
  let of_task ((task : Timed_analysis.task), windows) =
    let of_moment (m, w) = ([ Timed_system.moment_name m; task.name; task.vehicle; place task.site ], window w) in
    List.map of_moment windows
  in
  List.sort compare
    (List.map (fun (e, w) -> ([ Timed_system.ending_name e ], window w)) o.endings @ List.concat_map of_task o.tasks)

let limits states = { Dolphin_checker.Limits.none with max_states = Some states }

let prepare_one ~ticks ~states { case; durations; plans } =
  let options : Clocked.options =
    { environment = case.environment; program = case.program; world = case.world; durations;
      dates = Dolphin_semantics.Dated_code.named case.program } in
  let o = Timed_analysis.run (limits states) options in
  let tick = Dolphin_tla.Times.tick durations ~faults:case.environment.faults ~plans case.program case.world in
  if o.stopped <> None || o.endless <> None then None
  else
    match moments ~tick ~ticks case.program o with
    | exception Unfit -> None
    | expected ->
      let named = { case with plans = List.sort_uniq compare (plans @ case.plans) } in
      let constants = Translated.timed_constants { durations; tick; horizon = ticks + 1 } named in
      let prepared constants = { name = case.name; source = case.source; expected; constants } in
      Option.map prepared (Result.to_option constants)

let prepare ~ticks ~states cases =
  let one case = try prepare_one ~ticks ~states case with Dolphin_environment.Environment.Unclear _ -> None in
  List.filter_map one cases

(* {1 What TLC finds} *)

let describe (moment, (earliest, latest)) = Printf.sprintf "%s: %d to %d" (String.concat " " moment) earliest latest

let difference dates i p =
  let found = Printed_dates.windows dates (i + 1) in
  let only these those = List.map describe (List.filter (fun m -> not (List.mem m those)) these) in
  match only p.expected found, only found p.expected with
  | [], [] -> None
  | ours, theirs ->
    let all = function [] -> "nothing" | lines -> String.concat "; " lines in
    Some (Printf.sprintf "%s\nin ticks, dolphin time says: %s\nTLC says: %s\n%s" p.name (all ours) (all theirs) p.source)

let programs installation specification prepared =
  Result.bind (Family.files ~specification (List.map (fun p -> p.constants) prepared)) (fun files ->
      let dates = ref Printed_dates.none in
      let line text = Option.iter (fun d -> dates := d) (Printed_dates.line !dates text) in
      let outcome = Tlc_run.outcome ~line installation ~main:Family.timed ~configuration:Family.dates files in
      Result.bind (Tlc_run.judge outcome) (fun () ->
          match List.filter_map Fun.id (List.mapi (difference !dates) prepared) with
          | [] -> Ok ()
          | first :: _ -> Error first))

let has_other_ticks why =
  match Str.search_forward (Str.regexp_string "is no whole number of ticks") why 0 with
  | _ -> true
  | exception Not_found -> false

(* How many programs fail. Of several, each half is looked at by itself then. *)
let rec failures_of installation prepared =
  match programs installation Translated.specification prepared, prepared with
  | Ok (), _ -> 0
  | Error why, [ one ] when has_other_ticks why -> Printf.printf "  left out: %s: %s\n%!" one.name why; 0
  | Error why, [ one ] -> Printf.printf "%s: %s\n%!" one.name why; 1
  | Error _, _ -> Comparison.in_halves (failures_of installation) prepared

let report installation ~batch prepared =
  let start = Unix.gettimeofday () in
  let found = Parallel.map (failures_of installation) (Comparison.batches batch prepared) in
  let failures = List.fold_left ( + ) 0 found in
  Printf.printf "earliest and latest dates: %d programs, %s windows: %s\n  %.0f s\n%!" (List.length prepared)
    (Comparison.thousands (List.fold_left (fun n p -> n + List.length p.expected) 0 prepared))
    (if failures = 0 then "all agree" else Printf.sprintf "%d do not agree" failures)
    (Unix.gettimeofday () -. start);
  { Comparison.programs = List.length prepared; failures }
