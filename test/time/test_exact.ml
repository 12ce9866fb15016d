(* On random programs, the earliest and latest dates of ends and tasks are those of the enumeration second by second,
   and some run never ends in one if it does in the other; each run that is shown, with its dates, is one of the timed
   semantics. PROGRAMS in the environment is how many programs are tried, 400 by default. *)

open Dolphin_plans
open Dolphin_semantics
open Dolphin_environment
open Dolphin_time
module Generate = Test_support.Generate
module Calls = Test_support.Calls
module Posts = Test_support.Posts

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 400
let answering = Calls.answering

(* An uncertain event may come at any time, and no enumeration ends. *)
let certain = List.map (fun (i : Environment.input) -> { i with certain = true }) Posts.inputs

let environments =
  [ ("as planned", answering);
    ("with failures", Environment.failing answering);
    ("with a failure", Environment.failing ~failures:1 answering);
    ("with a loss", { answering with faults = { Faults.none with loss = At_most 1 } });
    ("with losses", { answering with faults = { Faults.none with loss = Any_number } });
    ( "with latecomers",
      { answering with faults = { Faults.none with join = Any_number }; may_be_late = (fun v -> v <> "a") } );
    ( "with all of it, once",
      { answering with faults = { Faults.none with fail = At_most 1; loss = At_most 1; join = At_most 1 } } );
    ("with inputs", { answering with inputs = certain });
    ("with interruptions", { answering with faults = { Faults.none with interrupt = true } }) ]

(* A second of work takes four parts in 40,000 of a battery; of rest it takes one, or gives a given number. Some plans
   give what [charges] lists. *)
let parts = 40_000

(* Durations in seconds, by the name of the plan and the vehicle: some exact, some zero, some overlapping. Some
   vehicles join after some seconds. *)
let durations ?(charges = []) ?(has_chargers = false) seed : Durations.t =
  let task v _ (p : Core.platform_task) =
    let n = Hashtbl.hash (seed, v, p.name) in
    let least = n mod 3 in
    Bounds.Within { least = 1000 * least; most = 1000 * (least + (n / 3 mod 3)) }
  in
  let posted key = if key = "y" then Bounds.exactly 2. else Bounds.between 1. 2. in
  let links =
    Links.of_silences
      (match seed mod 12 with
       | 0 | 1 -> [ ("b", [ (0., float (seed mod 4)) ]); ("a", [ (0., 3.) ]) ]
       | 2 -> [ ("c", [ (0., 1.) ]) ]
       | 3 -> [ ("a", [ (1., 4.) ]); ("b", [ (0., 1.); (2., 3.) ]) ]
       | 4 -> [ ("a", [ (2., infinity) ]); ("c", [ (1., 2.); (4., 5.) ]) ]
       | 5 -> [ ("a", [ (1., 2.) ]); ("b", [ (3., 6.) ]) ]
       | _ -> [])
  in
  { task; announced = Bounds.exactly 1.; silence = Bounds.exactly 2.; posted; place = (fun _ -> None); links;
    charges = (fun name -> Option.map (fun n -> float (3600 * n) /. float parts) (List.assoc_opt name charges));
    has_chargers = (fun _ -> has_chargers) }

let nested =
  let open QCheck2.Gen in
  let* depth = int_range 0 2 in
  let* posts = oneofl [ []; [ ("x", 1) ]; [ ("y", 2); ("x", 2) ] ] in
  let before = List.map (fun (k, x) -> Generate.statement (Generate.post k x)) posts in
  map (Generate.executing ~before) (Generate.nested ~vehicles:Generate.vehicles ~depth)

let case =
  let open QCheck2.Gen in
  let program = frequency [ (2, Generate.program); (1, Calls.within Generate.program); (3, nested) ] in
  triple program (int_bound 1_000_000) (oneofl environments)

let print (program, seed, (name, _)) = Printf.sprintf "%s, durations %d:\n%s" name seed (Generate.print program)

let pp_moment ppf : Enumeration.moment -> unit = function
  | Ended e ->
    Format.pp_print_string ppf
      (match e with Completed -> "completed" | Halted -> "halted" | Failed -> "failed" | Interrupted -> "interrupted")
  | Task (t, m) ->
    Format.fprintf ppf "%s on %s (%d) %s" t.name t.vehicle t.site
      (match m with Starts -> "starts" | Ends -> "ends" | Fails -> "fails" | Stopped -> "is stopped")

let few = { Dolphin_checker.Limits.none with max_states = Some 5_000 }
let skipped = ref 0 and endless = ref 0 and sensing = ref 0 and dated = ref 0 and reduced = Hashtbl.create 7

let seconds = function Timed_analysis.At n -> if n mod 1000 = 0 then n / 1000 else -1 | Unbounded -> max_int

let found (o : Timed_analysis.outcome) =
  let window (w : Timed_analysis.window) = (seconds (At w.earliest), seconds w.latest) in
  let of_task (task, moments) =
    List.map (fun (m, w) -> (Enumeration.Task (task, m), window w)) moments in
  List.sort compare
    (List.map (fun (e, w) -> (Enumeration.Ended e, window w)) o.endings @ List.concat_map of_task o.tasks)

(* The run ends at the date of its reported end, and its dates never go back. *)
let is_dated (o : Timed_analysis.outcome) (run : Timed_analysis.run) later =
  let rec in_order = function a :: (b :: _ as rest) -> a <= b && in_order rest | [ _ ] | [] -> true in
  let last = List.nth run.dates (List.length run.dates - 1) in
  let end_ (_, (w : Timed_analysis.window)) = if later then seconds w.latest else seconds (At w.earliest) in
  let ends = List.map end_ o.endings in
  let expected = List.fold_left (if later then max else min) (List.hd ends) ends in
  in_order run.dates && last = 1000 * expected
  && (run.chain = [] || (not later) || List.fold_left (fun n (l : Schedule.link) -> n + l.lasts) 0 run.chain >= last)

(* If code does more with the date than compare it with constants, the result is missing. *)
let enumerated ?batteries ?seen (options : Clocked.options) =
  if Result.is_ok options.dates then Enumeration.all ?batteries ?seen options else None

let is_found (options : Clocked.options) =
  let { Clocked.program; _ } = options in
  match enumerated options with
  | None -> if Result.is_ok options.dates then Test_support.Property.count skipped; true
  | Some expected ->
    let o = Timed_analysis.run Dolphin_checker.Limits.none options in
    if program.reads_now then Test_support.Property.count dated;
    if program.reads_sensors then Test_support.Property.count sensing;
    let say what moments =
      let one ppf (m, (a, b)) = Format.fprintf ppf "%a: %d to %d" pp_moment m a b in
      Format.asprintf "%s: %a" what (Format.pp_print_list ~pp_sep:(fun ppf () -> Format.fprintf ppf "; ") one) moments
    in
    (* If nothing happens any more, a person may interrupt at any time, and the vehicles leave then. *)
    let found = found o in
    let leaving (_, (_, latest)) = program.on_interrupt <> None && latest = max_int in
    let at_any_time = Enumeration.Ended Interrupted :: List.map fst (List.filter leaving found) in
    let matters (moment, _) = not (expected.never_over && List.mem moment at_any_time) in
    let found = List.filter matters found and expected_dates = List.filter matters expected.dates in
    if found <> expected_dates then
      QCheck2.Test.fail_reportf "%s@.%s"
        (say "expected" (List.filter (fun d -> not (List.mem d found)) expected_dates))
        (say "found" (List.filter (fun d -> not (List.mem d expected_dates)) found));
    if (o.endless <> None) <> expected.never_over then
      QCheck2.Test.fail_reportf "some run never ends in the %s, and none in the other"
        (if expected.never_over then "enumeration" else "analysis");
    if o.endless <> None then Test_support.Property.count endless;
    let count (e, _) = Hashtbl.replace reduced e () in
    List.iter count o.endings;
    let dated later run = is_dated o run later || QCheck2.Test.fail_report "a run has other dates" in
    let is_bounded = List.for_all (fun (_, (w : Timed_analysis.window)) -> w.latest <> Unbounded) o.endings in
    let all_dated () =
      Option.fold ~none:true ~some:(dated true) o.last && Option.fold ~none:true ~some:(dated false) o.first in
    (not is_bounded) || all_dated ()

(* As in the worlds of fleets: [connected(v)] is open, since changes of links that no [pick] depends on are left out. *)
let with_open_links (durations : Durations.t) world =
  let opened world (v, _) = World.open_sensor Connected v [ Boolean true; Boolean false ] world in
  List.fold_left opened world (Links.changes durations.links)

let agrees_in open_ (ast, seed, (_, environment)) =
  let program = Posts.declared environment (Generate.compile ast) in
  let world = if open_ && program.reads_sensors then Generate.open_world else Generate.world in
  let durations = durations seed in
  let world = with_open_links durations world in
  is_found { environment; program; world; durations; dates = Dated_code.named program }

let sensing_case =
  let open QCheck2.Gen in
  let* depth = int_range 0 2 in
  let nested =
    map (Generate.executing ~before:[ Generate.kept ]) (Generate.sensing_nested ~vehicles:Generate.vehicles ~depth) in
  triple (frequency [ (1, Generate.sensing_program); (2, nested) ]) (int_bound 1_000_000) (oneofl environments)

let test_agreement () =
  let cases = QCheck2.Gen.frequency [ (3, case); (1, sensing_case) ] in
  let test = QCheck2.Test.make ~count:programs ~print ~name:"zones and enumeration agree" cases (agrees_in true) in
  Test_support.Property.on_each_seed ~usual:20_261_123 ~programs test;
  Printf.printf "%d skipped, %d with runs that never end, %d that look at sensors\n" !skipped !endless !sensing

(* {1 Vehicles that join} *)

(* Programs look for vehicles again and again, and for as long as some join. *)
let looking =
  let open QCheck2.Gen in
  let look i =
    let* seconds = int_range 0 4 in
    let whom what = Printf.sprintf "v%d = pick { %s; timeout %d } else { null }\n" i what seconds in
    let* what = oneofl [ "id 'a'"; "id 'b'"; "type 'UUV'"; "count 2"; "count 3"; "count _" ] in
    let first = if String.length what > 5 && String.sub what 0 5 = "count" then Printf.sprintf "v%d[0]" i
      else Printf.sprintf "v%d" i in
    let* deed =
      oneofl
        [ ""; Printf.sprintf "if (v%d) execute task('p')[%s]\n" i first;
          Printf.sprintf "if (v%d) execute watch (idle(1) >> task('q')[%s]) onError { ignore() }\n" i first;
          Printf.sprintf "if (v%d) execute (watch task('p')[%s] onError { retry() }) during 6\n" i first;
          Printf.sprintf "if (v%d) execute task('q')[%s] | idle(1)\n" i first;
          Printf.sprintf "if (v%d) { execute task('q')[%s]; release %s } else pause 1\n" i first first ] in
    return (whom what ^ deed)
  in
  let recruit =
    map2 (Printf.sprintf "execute (recruit { %s } then { v -> task('p') }) | idle(%d)\n")
      (oneofl [ "id 'b'"; "type 'UUV'" ]) (int_range 0 3) in
  let statement i =
    frequency [ (4, look i); (1, recruit); (1, map (Printf.sprintf "pause %d\n") (int_range 1 2)) ] in
  let* n = int_range 1 3 in
  map (String.concat "") (flatten_l (List.init n statement))

(* Each vehicle is silent for none, one or two spans, which do not touch. *)
let silences =
  let open QCheck2.Gen in
  let of_dates dates =
    let rec pairs = function
      | a :: b :: rest -> (Stdlib.float a, Stdlib.float b) :: pairs rest
      | [ a ] -> [ (Stdlib.float a, infinity) ]
      | [] -> []
    in
    pairs (List.sort_uniq Int.compare dates)
  in
  let dates = frequency [ (2, return []); (2, map (fun n -> [ 0; n ]) (int_range 1 4));
                          (4, list_size (int_range 1 4) (int_range 0 6)) ] in
  map of_dates dates

let linked =
  let open QCheck2.Gen in
  let of_vehicle v = map (fun spans -> (v, spans)) silences in
  triple looking (int_bound 1_000_000) (flatten_l (List.map of_vehicle [ "a"; "b"; "c" ]))

let print_linked (text, seed, silences) =
  let span ppf (from, until) = Format.fprintf ppf " %g-%g" from until in
  let one ppf (v, spans) = Format.fprintf ppf "%s:%a" v (Format.pp_print_list ~pp_sep:(fun _ () -> ()) span) spans in
  Format.asprintf "silent %a, durations %d:@.%s" (Format.pp_print_list ~pp_sep:Format.pp_print_space one) silences seed
    text

let linked_case = QCheck2.Gen.(pair linked (oneofl [ answering; Environment.failing answering ]))
let print_linked_case (case, _) = print_linked case

let linked_options ((text, seed, silences), environment) : Clocked.options =
  let program = Test_support.Pure_run.compile_exn text in
  { environment; program; world = Generate.world;
    durations = { (durations seed) with links = Links.of_silences silences }; dates = Ok Dated_code.no_dates }

let test_links () =
  let is_found case = is_found (linked_options case) in
  let print = print_linked_case in
  let test = QCheck2.Test.make ~count:programs ~print ~name:"whose link is silent when" linked_case is_found in
  let before = !skipped in
  Test_support.Property.on_each_seed ~usual:20_261_123 ~programs test;
  Printf.printf "%d skipped\n" (!skipped - before);
  Alcotest.(check bool) "few are skipped" true ((!skipped - before) * 2 < programs)

(* {1 Dates that code reads} *)

(* The values of sensors stay, and the date passes. *)
let test_dates () =
  let test = QCheck2.Test.make ~count:programs ~print ~name:"dates that code reads" sensing_case (agrees_in false) in
  let before = !skipped in
  Test_support.Property.on_each_seed ~usual:20_261_124 ~programs test;
  Printf.printf "%d skipped, %d read the date so far\n" (!skipped - before) !dated;
  skipped := before;
  Alcotest.(check bool) "many read the date" true (!dated > programs / 10)

(* {1 Slack} *)

let latest_of (expected : Enumeration.t) =
  let is_end (moment, _) = match moment with Enumeration.Ended _ -> true | Task _ -> false in
  List.fold_left (fun latest (_, (_, last)) -> max latest last) 0 (List.filter is_end expected.dates)

(* With [task] this number of seconds longer. *)
let longer (o : Clocked.options) (task : Timed_analysis.task) n =
  let of_task v place (p : Core.platform_task) : Bounds.t =
    match o.durations.task v place p with
    | Within { least; most } when task = { name = p.name; vehicle = v; site = p.task_site } ->
      Within { least; most = most + (1000 * n) }
    | bounds -> bounds
  in
  { o with durations = { o.durations with task = of_task } }

let tight = ref 0 and loose = ref 0

(* A task may take as much longer as its slack, and no second more. *)
let slack_agrees (ast, seed, (_, environment)) =
  let program = Posts.declared environment (Generate.compile ast) in
  let options : Clocked.options =
    { environment; program; world = Generate.world; durations = durations seed; dates = Dated_code.named program } in
  match Enumeration.all options with
  | None -> true
  | Some { never_over = true; _ } -> true
  | Some expected ->
    let o = Timed_analysis.run Dolphin_checker.Limits.none options in
    let latest = latest_of expected in
    let ends_then task n =
      match Enumeration.all (longer options task n) with
      | None -> None
      | Some e -> Some ((not e.never_over) && latest_of e = latest)
    in
    let check (task : Timed_analysis.task) n same =
      if ends_then task n = Some (not same) then
        QCheck2.Test.fail_reportf "%s on %s (%d) with %d s more" task.name task.vehicle task.site n
    in
    let compare ((task : Timed_analysis.task), (slack : Slack.t)) =
      match slack with
      | Any -> incr loose; check task 7 true
      | By ms -> incr tight; check task (ms / 1000) true; check task ((ms / 1000) + 1) false
    in
    let { Timed_analysis.known = slacks; _ } = Timed_analysis.slacks Dolphin_checker.Limits.none options o in
    List.iter compare slacks;
    List.length slacks = List.length o.tasks

let test_slack () =
  let programs = programs / 3 in
  let test = QCheck2.Test.make ~count:programs ~print ~name:"slack and enumeration agree" case slack_agrees in
  Test_support.Property.on_each_seed ~usual:20_261_123 ~programs test;
  Alcotest.(check bool) "some have slack, and some do not matter" true (!tight > 0 && !loose > 0)

(* {1 Plans side by side} *)

module Side_by_side = Dolphin_explore.Side_by_side

let distance : Fences.fence =
  { rule = Distance 10.; margin = 0.; text = "fence distance 10.m"; at = Dolphin_syntax.Location.none }

let together = ref 0 and apart = ref 0

let names (pairs : Side_by_side.pair list) =
  let key ((_, p) : _ * Core.platform_task) = (p.task_site, p.name) in
  let pair (p : Side_by_side.pair) = List.sort compare [ key p.one; key p.other ] in
  List.sort_uniq compare (List.map pair pairs)

(* The ends of these plans are unknown, so all that run at one time are reported. *)
let pairs_agree (ast, seed, (_, environment)) =
  let program = { (Posts.declared environment (Generate.compile ast)) with fences = Fences.make [ distance ] } in
  let options : Clocked.options =
    { environment; program; world = Generate.world; durations = durations seed; dates = Dated_code.named program } in
  let expected = Side_by_side.create program.fences in
  match Enumeration.all ~look:(fun c -> Side_by_side.see expected c.shared.allocation) options with
  | None | Some { never_over = true; _ } -> true
  | Some _ ->
    let limits = { Dolphin_checker.Limits.none with max_states = Some 5_000 } in
    match (Timed_analysis.run limits options).apart with
    | None -> false
    | Some { cut_short = Some _; _ } -> true
    | Some { pairs; _ } ->
      let untimed, _ =
        Dolphin_explore.Search.(side_by_side { default with environment; limits }) program options.world in
      let found = names pairs in
      together := !together + List.length found;
      apart := !apart + List.length (names untimed) - List.length found;
      found = names (Side_by_side.pairs expected)

let test_pairs () =
  let test = QCheck2.Test.make ~count:programs ~print ~name:"pairs and enumeration agree" case pairs_agree in
  Test_support.Property.on_each_seed ~usual:20_261_123 ~programs test;
  Printf.printf "%d pairs at one time, %d by order alone\n" !together !apart;
  Alcotest.(check bool) "some run at one time, some do not though they might by their order" true
    (!together > 0 && !apart > 0)

(* {1 Batteries} *)

let fleet ?(charges = []) ?(charger = "") ?rest ~at_first ~charge () =
  let rest = Option.value rest ~default:(if charge = 0 then -1 else charge) in
  let battery : Enumeration.battery = { at_first; work = 4; rest; charges } in
  let percent n = 100. *. float n /. float parts in
  let vehicle v =
    Printf.sprintf "vehicle '%s', { type 'UUV'; drain 36.percent; battery %.12g.percent; charge %.12g.percent%s }\n" v
      (100. -. percent at_first) (percent (3600 * charge)) charger
  in
  let ids = [ "a"; "b"; "c" ] in
  match Dolphin_scenario.Scenario.read ~file:"batteries" (String.concat "" (List.map vehicle ids)) with
  | Ok scenario -> (scenario.vehicles, List.map (fun v -> (v, battery)) ids)
  | Error _ -> failwith "the fleet is wrong"

type tally = { mutable exact : int; mutable bounds : int; mutable worked : int }

let no_batteries () = { exact = 0; bounds = 0; worked = 0 }

(* No run has less left than the bound; the run that is shown has no less than the least of all. *)
let batteries_agree tally (vehicles, batteries) options =
  match Enumeration.all ~batteries options with
  | None | Some { never_over = true; _ } -> true
  | Some expected ->
    let o = Timed_analysis.run ~vehicles Dolphin_checker.Limits.none options in
    let check (b : Timed_analysis.battery) =
      match List.assoc_opt b.vehicle expected.most with
      | None -> QCheck2.Test.fail_reportf "%s never works" b.vehicle
      | Some missing ->
        let left = 1. -. (float missing /. float parts) in
        let is_bound = b.least <= left +. 1e-9 in
        let is_reached = Option.fold b.lowest ~none:true ~some:(fun (lowest, _) -> lowest >= left -. 1e-9) in
        tally.worked <- tally.worked + 1;
        let is_exact = Option.fold b.lowest ~none:false ~some:(fun (x, _) -> x -. b.least < 1e-9) in
        if is_exact then tally.exact <- tally.exact + 1
        else tally.bounds <- tally.bounds + 1;
        (is_bound && is_reached)
        || QCheck2.Test.fail_reportf "%s: %.9g is least, %.9g or more is said, %.9g in a run" b.vehicle left b.least
          (Option.fold b.lowest ~none:nan ~some:fst)
    in
    let is_told (v, _) = List.exists (fun (b : Timed_analysis.battery) -> b.vehicle = v) o.batteries in
    let is_bounded = List.for_all (fun (_, (w : Timed_analysis.window)) -> w.latest <> Unbounded) o.endings in
    List.for_all check o.batteries && ((not is_bounded) || List.for_all is_told expected.most)

let test_batteries_of ?charges cases ~print options ~at_first ~charge ~programs () =
  let tally = no_batteries () and others = no_batteries () in
  let property case =
    let o : Clocked.options = options case in
    (* Of programs that look at their vehicles there are bounds. *)
    let is_counted = Test_support.Property.is_usual () && not o.program.reads_sensors in
    batteries_agree (if is_counted then tally else others) (fleet ?charges ~at_first ~charge ()) o
  in
  let test = QCheck2.Test.make ~count:programs ~print ~name:"batteries and enumeration agree" cases property in
  Test_support.Property.on_each_seed ~usual:20_261_123 ~programs test;
  Printf.printf "%d exact, %d bounds, of %d vehicles that work\n" tally.exact tally.bounds tally.worked;
  Alcotest.(check bool) "most are exact" true (tally.worked > 0 && tally.exact > 2 * tally.bounds)

let battery_options ?charges (ast, seed, (_, environment)) : Clocked.options =
  let program = Posts.declared environment (Generate.compile ast) in
  { environment; program; world = Generate.world; durations = durations ?charges seed;
    dates = Dated_code.named program }

let test_batteries = test_batteries_of case ~print (battery_options ?charges:None)

(* Plan p charges as fast as two vehicles work, q not at all, and the others drain. *)
let test_charging_plans =
  let charges = [ ("p", 8); ("q", 0) ] in
  test_batteries_of ~charges case ~print (battery_options ~charges)

let test_linked_charging_plans =
  let charges = [ ("p", 8); ("q", 0) ] in
  let options case : Clocked.options =
    let o = linked_options case in
    { o with durations = { o.durations with charges = (durations ~charges 0).charges } } in
  test_batteries_of ~charges linked_case ~print:print_linked_case options

(* The analysis does not know the places where vehicles rest: its bound holds if all rest at a charger, and if none
   does. *)
let test_chargers ~programs () =
  let tally = no_batteries () in
  let charger = "; charger Location.APDL, 30.m" in
  let property (ast, seed, (_, environment)) =
    let o = battery_options (ast, seed, ("", environment)) in
    let o = { o with durations = durations ~has_chargers:true seed } in
    List.for_all
      (fun rest -> batteries_agree tally (fleet ~charger ~rest ~at_first:20 ~charge:40 ()) o) [ -1; 40 ]
  in
  let test = QCheck2.Test.make ~count:programs ~print ~name:"bounds hold wherever vehicles rest" case property in
  Test_support.Property.on_each_seed ~usual:20_261_123 ~programs test;
  Alcotest.(check (pair bool int)) "vehicles work, and no run is shown" (true, 0) (tally.worked > 0, tally.exact)

let test_linked_batteries = test_batteries_of linked_case ~print:print_linked_case linked_options

(* {2 What a program sees of its batteries} *)

let with_battery v share world =
  match World.find v world with Some s -> World.add { s with battery = Some share } world | None -> world

let seen v missing = with_battery v (1. -. (float missing /. float parts))
let looks = ref 0 and close = ref 0

(* Batteries have some seconds of work more than the 30 % and 50 % that programs compare them with. In the enumeration,
   the program sees what there is; here that is open. *)
let looks_agree (ast, seed, (_, environment)) =
  let left = if seed mod 2 = 0 then 0.3 else 0.5 in
  let at_first = parts - int_of_float (left *. float parts) - (seed mod 30) in
  let vehicles, batteries = fleet ~at_first ~charge:(if seed mod 3 = 0 then 6 else 0) () in
  let program = Posts.declared environment (Generate.compile ast) in
  let durations = durations seed in
  let world = List.fold_left (fun w (v, _) -> World.open_battery v [] w) Generate.world batteries in
  let world = with_open_links durations world in
  let options world : Clocked.options =
    { environment; program; world; durations; dates = Dated_code.named program } in
  match enumerated ~batteries ~seen (options Generate.world) with
  | None -> true
  | Some expected ->
    let o = Timed_analysis.run ~vehicles few (options world) in
    let check (b : Timed_analysis.battery) =
      match List.assoc_opt b.vehicle expected.most with
      | None -> ()
      | Some missing ->
        let left = 1. -. (float missing /. float parts) in
        if program.reads_sensors && b.least > 0. then incr (if left -. b.least < 0.001 then close else looks);
        if b.least > left +. 1e-9 then
          QCheck2.Test.fail_reportf "%s: %.9g is least, and %.9g or more is said" b.vehicle left b.least
    in
    List.iter check o.batteries;
    true

let test_looks () =
  let programs = programs / 2 in
  let test = QCheck2.Test.make ~count:programs ~print ~name:"no less than is said" sensing_case looks_agree in
  Test_support.Property.on_each_seed ~usual:20_261_123 ~programs test;
  Printf.printf "%d bounds are close, %d are not\n" !close !looks

let compare_one environment seed text =
  let program = Test_support.Pure_run.compile_exn text in
  let world = if program.reads_sensors then Generate.open_world else Generate.world in
  let options : Clocked.options =
    { environment = List.assoc environment environments; program; world; durations = durations seed;
      dates = Dated_code.named program } in
  match Enumeration.all options with
  | None -> Alcotest.fail "too much to enumerate"
  | Some expected ->
    let o = Timed_analysis.run Dolphin_checker.Limits.none options in
    Alcotest.(check bool) "the same dates" true (found o = expected.dates);
    Alcotest.(check bool) "whether some run never ends" expected.never_over (o.endless <> None)

(* If one link is lost, time has not passed because another one might have been. *)
let test_one_loss () =
  compare_one "with a loss" 132
    "va = pick { id 'a' }\nvb = pick { id 'b' }\nvc = pick { id 'c' }\n\
     execute (watch task('p')[vb] onError { ignore() }) | { task('p') } | task('p')[va] | task('q')[vc]\n"

(* If vehicles may be late, links are not silent when the fleet has them silent: not in a run without faults either. *)
let test_links_without_faults () =
  compare_one "with all of it, once" 512_799
    "va = pick { count _ }\nexecute waitFor { running(va) } then condition { true }\n"

(* The search comes to both states of the rounds before it goes from one to the other. *)
let test_round_in_no_time () =
  compare_one "as planned" 396227
    "va = pick { id 'a' }\npost x: 1\n\
     execute (waitFor { true } then repeat task('p')[va] until { poll x: 1 }) | assert({ consume x: 1 }, 'a')\n"

(* A round that is left, and begun again, by looks that contradict each other cannot repeat at one moment. *)
let test_contradicting_round () =
  compare_one "as planned" 2
    "va = pick { id 'a' }\n\
     execute during 1 run (repeat until { battery(va) < 0.3 } run (until { !(battery(va) < 0.3) } run task('p')[va]))\n"

(* A sensor may end a task at the moment at which something else happens at once. *)
let test_look_at_once () =
  compare_one "as planned" 0
    "va = pick { id 'a' }\nvb = pick { id 'b' }\n\
     execute until { battery(va) < 0.5 } run (action { halt 'h' } | task('p')[vb])\nexecute task('q')[va]\n"

(* Whether the guard sees that a task has started makes a difference of seconds, so START comes not always first. *)
let test_named () =
  let dates ?begins text expected =
    let program = { (Test_support.Pure_run.compile_exn text) with begins } in
    let found = Result.map (fun { Dated_code.once; daily } -> (once, daily)) (Dated_code.named program) in
    Alcotest.(check (option (pair (list int) (list int)))) text expected (Result.to_option found)
  in
  let named text expected = dates text (Option.map (fun once -> (once, [])) expected) in
  let begins = Result.get_ok (Calendar.read ~zone:0 "2026-06-01 20:00") in
  let daily text expected = dates ~begins text (Option.map (fun daily -> ([], daily)) expected) in
  named "post x: 1" (Some []);
  named "if (now() < 5) { post x: 1 }" (Some [ 5 ]);
  named "if (now() <= 5) { post x: 1 }" (Some [ 6 ]);
  named "if (5 < now()) { post x: 1 }" (Some [ 6 ]);
  named "if (4.5 >= now()) { post x: 1 }" (Some [ 5 ]);
  named "if (now() == 2.min || now() != 0.5) { post x: 1 }" (Some [ 1; 120; 121 ]);
  named "parameter p = 3\nl = p.min\nexecute condition { now() >= l - 1 }" (Some [ 179 ]);
  named "l = 3\nexecute action { l = 8 } >> condition { now() >= l }" (Some [ 3; 8 ]);
  named "l = 3\nexecute action { l = l + 1 } >> condition { now() >= l }" None;
  named "message now()\nmessage \"at ${now()}\"" (Some []);
  named "message now() + 1\nmessage \"${(now() / 60).round(1)} min\"" (Some []);
  named "message(now() / 2 > 3)" None;
  named "message(now() + 1 > 3)" None;
  named "message((now() - 1) in [3])" None;
  named "start = now()" None;
  named "execute condition { now() - 1 > 3 }" None;
  named "def late(n) { now() > n }\nexecute condition { late(3) }" (Some [ 4 ]);
  named "def late(n) { condition { def m = n + 1; now() > m } }\nexecute late(3) >> late(5)" (Some [ 5; 7 ]);
  named "def late(n) { condition { now() > n } }\nl = 3\nexecute late(l)" (Some [ 4 ]);
  named "def late(n) { condition { now() > n } }\nl = 3\nexecute late(l)\nl = l + 1\nexecute late(l)" None;
  named "ts = [3, 5].collect { n -> condition { now() > n } }\nexecute ts[0]" None;
  named "def late(n) { n = n + 1; return condition { now() > n } }\nexecute late(3)" None;
  (* At 20:00 four hours are left of the day. *)
  daily "if (timeOfDay() < timeOfDay('21:30')) { post x: 1 }" (Some [ 5_400; 14_400 ]);
  daily "if (timeOfDay() > 77400) { post x: 1 }" (Some [ 5_401; 14_400 ]);
  daily "if (timeOfDay() >= 0 || timeOfDay() < 1e5) { post x: 1 }" (Some [ 14_400 ]);
  daily "def at(t) { condition { timeOfDay() >= timeOfDay(t) } }\nexecute at('06:00') >> at('20:00')"
    (Some [ 0; 14_400; 36_000 ]);
  daily "message timeOfDay()" (Some []);
  daily "message timeOfDay() - 5 > 3" None;
  daily "t = timeOfDay()" None;
  dates ~begins "if (now() < 5) { execute condition { timeOfDay() < 1 } }" (Some ([ 5 ], [ 14_400; 14_401 ]));
  dates "message timeOfDay() > 3" None

(* The dates one after another are those at which the code does something else, second by second. *)
let test_following () =
  let begins = Result.get_ok (Calendar.read ~zone:0 "2026-06-01 20:00") in
  let source = "execute condition { now() >= 200000 || timeOfDay() >= 77400 || timeOfDay() < 100 }" in
  let program = { (Test_support.Pure_run.compile_exn source) with begins = Some begins } in
  let dates = Result.get_ok (Dated_code.named program) in
  let holds n = n >= 200_000 || Calendar.at begins n >= 77_400 || Calendar.at begins n < 100 in
  let rec go n passed = if n > 400_000 then List.rev passed else
      match Dated_code.following dates n with Some k -> go k (k :: passed) | None -> List.rev passed in
  let passed = go 0 [] in
  let rec check n = function
    | k :: rest when k = n + 1 -> Alcotest.(check int) "latest" k (Dated_code.latest dates (n + 1)); check (n + 1) rest
    | rest when n < 400_000 ->
      if holds n <> holds (n + 1) then Alcotest.failf "%d is not among the dates" (n + 1);
      check (n + 1) rest
    | _ -> ()
  in
  check 0 passed;
  let same n =
    let m = Dated_code.repeated dates n in
    m < 400_000 && holds m = holds n
    && Option.map (fun k -> k - n) (Dated_code.following dates n)
       = Option.map (fun k -> k - m) (Dated_code.following dates m)
  in
  for i = 0 to 2_000 do
    let n = i * 997 in
    Alcotest.(check bool) (Printf.sprintf "repeated from %d" n) true (same n)
  done

(* On the stroke of a date, whatever is due comes before or after. *)
let test_on_the_stroke () =
  compare_one "as planned" 7
    "va = pick { id 'a' }\nlimit = 2\nexecute idle(2) | condition { now() >= 1 }\nif (now() < limit) \
     { execute task('p')[va] } else { execute task('q')[va] }\nwhile (now() <= 5) { pause 2 }\n\
     limit = 4\nif (now() < limit) { execute condition { false } }\n"

let test_who_runs () =
  compare_one "as planned" 7
    "va = pick { id 'a' }\nvb = pick { id 'b' }\n\
     execute task('p')[va] | (oneOf {\n when { !running(va) } then (task('q')[vb] >> task('q')[vb])\n\
     when { running(va) } then idle(1)\n})\n"

(* Without programs that end in each way, agreement means little. *)
let test_variety () =
  Alcotest.(check int) "ways to end" 4 (Hashtbl.length reduced);
  Alcotest.(check bool) "few are skipped" true (!skipped * 2 < programs);
  Alcotest.(check bool) "some never end" true (!endless > 0);
  Alcotest.(check bool) "some look at sensors" true (!sensing > 0)

let () =
  Alcotest.run "exact"
    [ ("random programs", [ Alcotest.test_case "zones and enumeration" `Quick test_agreement;
                            Alcotest.test_case "dates that code reads" `Quick test_dates;
                            Alcotest.test_case "variety" `Quick test_variety;
                            Alcotest.test_case "links that come and go" `Quick test_links;
                            Alcotest.test_case "slack" `Quick test_slack;
                            Alcotest.test_case "plans side by side" `Quick test_pairs;
                            Alcotest.test_case "batteries" `Quick (test_batteries ~at_first:0 ~charge:0 ~programs);
                            Alcotest.test_case "batteries that are charged" `Quick
                              (test_batteries ~at_first:7 ~charge:3 ~programs:(programs / 2));
                            Alcotest.test_case "batteries that are charged fast" `Quick
                              (test_batteries ~at_first:20 ~charge:40 ~programs:(programs / 2));
                            Alcotest.test_case "plans that charge" `Quick
                              (test_charging_plans ~at_first:30 ~charge:0 ~programs);
                            Alcotest.test_case "plans that charge, and rest that charges" `Quick
                              (test_charging_plans ~at_first:20 ~charge:3 ~programs:(programs / 2));
                            Alcotest.test_case "plans that charge, and links that come and go" `Quick
                              (test_linked_charging_plans ~at_first:20 ~charge:0 ~programs);
                            Alcotest.test_case "batteries that are charged at chargers" `Quick
                              (test_chargers ~programs:(programs / 4));
                            Alcotest.test_case "batteries, and links that come and go" `Quick
                              (test_linked_batteries ~at_first:0 ~charge:0 ~programs);
                            Alcotest.test_case "batteries that are charged, and links that come and go" `Quick
                              (test_linked_batteries ~at_first:20 ~charge:40 ~programs:(programs / 2));
                            Alcotest.test_case "batteries that the program sees" `Quick test_looks ]);
      ("programs", [ Alcotest.test_case "one loss" `Quick test_one_loss;
                     Alcotest.test_case "links without faults" `Quick test_links_without_faults;
                     Alcotest.test_case "a look at once" `Quick test_look_at_once;
                     Alcotest.test_case "a round in no time" `Quick test_round_in_no_time;
                     Alcotest.test_case "a round of contradicting looks" `Quick test_contradicting_round;
                     Alcotest.test_case "dates that code names" `Quick test_named;
                     Alcotest.test_case "dates one after another" `Quick test_following;
                     Alcotest.test_case "on the stroke of a date" `Quick test_on_the_stroke;
                     Alcotest.test_case "who runs" `Quick test_who_runs ]) ]
