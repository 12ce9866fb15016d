(* Journals and displays never change a run: random programs on random fleets, with and without a journal, a picture,
   a follower, telemetry for displays, debug messages. Transitions, their times and causes, the outcome and the time
   of the end are compared. Nor does a replacement of the program by itself, or by one that differs later, when it is
   made: the run is that of the new program. PROGRAMS in the environment is the number of programs, 20 by default. *)

open Dolphin_semantics
open Dolphin_runtime
open Dolphin_app
module Scenario = Dolphin_scenario.Scenario
module Generate = Test_support.Generate
module Calls = Test_support.Calls

(* {1 Kinds of recording} *)

(* Another program in a file, asked for at some transitions. *)
type other = { path : string; is_due : int -> bool }

type kind = {
  name : string;
  recording : Recording.settings;
  telemetry : bool;
  messages : bool;
  other : other option;
}

let temporary ending = Filename.temp_file "dolphin" ending

let with_temporary f =
  let journal = temporary ".run" and picture = temporary ".svg" in
  Sys.remove journal;
  let remove path = try Sys.remove path with Sys_error _ -> () in
  Fun.protect ~finally:(fun () -> List.iter remove [ journal; picture ]) (fun () -> f ~journal ~picture)

let kinds ~journal ~picture =
  let nothing = Recording.nothing in
  let kind ?(recording = nothing) ?(telemetry = false) ?(messages = false) name =
    { name; recording; telemetry; messages; other = None } in
  let drawing = Result.to_option (Drawing.of_path picture) in
  [ kind "a journal" ~recording:{ nothing with journal = Some journal };
    kind "a picture" ~recording:{ nothing with drawing };
    kind "a follower" ~recording:{ nothing with follower = Some ignore };
    kind "telemetry" ~telemetry:true;
    kind "messages" ~messages:true;
    kind "all of them" ~telemetry:true ~messages:true
      ~recording:{ journal = Some journal; drawing; follower = Some ignore } ]

(* {1 Runs} *)

(* Enough of a run that does not end. *)
let most_transitions = 400

exception Enough

(* Makes each message and shows none. *)
let silent =
  let nowhere = Format.make_formatter (fun _ _ _ -> ()) ignore in
  let report _ _ ~over k message =
    message (fun ?header:_ ?tags:_ format -> Format.kfprintf (fun _ -> over (); k ()) nowhere format) in
  { Logs.report }

let cause ppf = function None -> () | Some event -> Dolphin_trace.Event.(pp ppf (of_event event))

let replaced = ref 0
let refused = ref None

let ask_for other (view : Run.view) n =
  if other.is_due n then
    Lwt.async (fun () ->
        Lwt.map
          (function
            | Ok _ -> incr replaced
            | Error (Replacement.Busy | Over) -> ()
            | Error (No_journal | Wrong_program _ | Differs _ as refusal) ->
              refused := Some (Replacement.message refusal))
          (view.replace other.path))

(* The run, a line for each transition, and its end. *)
let happened (program : Program_file.t) scenario ~seed { recording; telemetry; messages; other; name = _ } =
  let lines = ref [] and left = ref most_transitions in
  let add line = lines := line :: !lines in
  let view = ref None in
  let transition ~time ~cause:why (t : Transition.t) =
    if !left = 0 then raise Enough;
    decr left;
    add (Format.asprintf "%g %a %a" time Label.pp t.label cause why);
    Option.iter (fun other -> Option.iter (fun view -> ask_for other view !left) !view) other
  in
  let front =
    { Run.unattended with
      wants_telemetry = telemetry; opened = (fun opened -> view := Some opened);
      observer = { Observer.nobody with transition } }
  in
  let fleet = { Fleet_file.nobody with scenario } in
  let settings = { Run.simulated with seed = Some seed; recording } in
  Logs.set_reporter silent;
  Logs.set_level (if messages then Some Debug else None);
  (match Lwt_main.run (Run.start front ~interruption:(Interruption.make ()) settings program fleet) with
   | Ok outcome ->
     let time = Option.fold !view ~none:0. ~some:(fun (view : Run.view) -> view.now ()) in
     add (Format.asprintf "%g %a" time Driver.pp_outcome outcome)
   | Error e -> add (Format.asprintf "%a" Error.pp e)
   | exception Enough -> add "and so on");
  List.rev !lines

let first_difference plain recorded =
  let rec go n = function
    | x :: xs, y :: ys when x = y -> go (n + 1) (xs, ys)
    | x :: _, y :: _ -> Some (n, x, y)
    | [], y :: _ -> Some (n, "nothing", y)
    | x :: _, [] -> Some (n, x, "nothing")
    | [], [] -> None
  in
  go 1 (plain, recorded)

let compared = ref 0

let program_of source : Program_file.t =
  { path = "random.dol"; source; parameters = []; set = []; program = Test_support.Pure_run.compile_exn source;
    warnings = []; ast = []; without_place = lazy []; plans = (fun ~place:_ -> []) }

let plain = { name = ""; recording = Recording.nothing; telemetry = false; messages = false; other = None }

let is_unchanged ~seed scenario source =
  let program = program_of source in
  let expected = happened program scenario ~seed plain in
  compared := !compared + List.length expected;
  let check ~journal kind =
    (* That of a run that was left off would be spared. *)
    if Sys.file_exists journal then Sys.remove journal;
    match first_difference expected (happened program scenario ~seed kind) with
    | None -> ()
    | Some (n, x, y) -> Alcotest.failf "with %s, line %d is '%s' instead of '%s'" kind.name n y x
  in
  with_temporary (fun ~journal ~picture -> List.iter (check ~journal) (kinds ~journal ~picture))

(* {1 Random programs and fleets} *)

let fleet =
  let open QCheck2.Gen in
  let time = map float_of_int (int_range 1 200) in
  let first = List.hd Scenario.default.vehicles in
  let vehicle id kind north =
    let* joins = frequency [ (4, return 0.); (1, time) ]
    and* drops = frequency [ (4, return []); (1, map2 (fun from lasts -> [ { Scenario.from; lasts } ]) time time) ]
    and* drain = oneofl [ 0.; 0.1; 12. ] in
    let position = (Test_support.Pure_run.vehicle ~north id).position in
    return { first with id; kind; position; joins; drops; drain; payload = [] }
  in
  let plan name =
    let* least = time and* more = time and* ending = oneofl [ Scenario.Succeeds; Succeeds; May_fail 0.5; Fails ] in
    let duration = Some { Scenario.least; most = least +. more } in
    return { Scenario.name; duration; ending; place = None; only = []; charges = None }
  in
  let input key =
    let* after = opt time and* times = int_range 1 3 in
    return { Scenario.key; rounds = [ [ Core.Boolean true ] ]; after; times }
  in
  let* vehicles = flatten_l [ vehicle "a" "UUV" 0.; vehicle "b" "UUV" 100.; vehicle "c" "UAV" 200. ]
  and* plans = flatten_l [ plan "p"; plan "q" ]
  and* inputs = flatten_l [ input "abort" ]
  and* yes_or_no = oneofl [ [ "yes" ]; [ "no" ] ] in
  let go i : Scenario.answer = { prompt = Printf.sprintf "go %d?" i; texts = yes_or_no } in
  let answers = { Scenario.prompt = "how many?"; texts = [ "1"; "2" ] } :: List.init 3 go in
  let reply call : Scenario.reply = { call; rounds = Calls.replies call } in
  return
    { Scenario.vehicles; plans; answers; replies = List.map reply Calls.names; inputs; samples = []; fences = [];
      plans_at = None; recurrences = []; begins = None; zone = None }

(* Waits that only an input, a vehicle that comes, or nothing at all can end. *)
let waits =
  [ ""; ""; "execute until { poll abort: true } run condition { poll never: 1 }";
    "execute condition { consume abort: true } | condition { poll never: 1 }";
    "execute recruit { type 'ROV' } then { v -> task('p')[v] }";
    "execute during 90.seconds run condition { poll never: 1 }";
    "execute task('p') | condition { poll never: 1 }" ]

let random_case =
  let open QCheck2.Gen in
  let declarations = oneofl [ ""; "input 'abort'\n"; "onInterrupt task('p')\n"; "input 'abort'\nonInterrupt task('q')\n" ] in
  let* ast = oneof [ Generate.program; Generate.sensing_program; Calls.within Generate.program ]
  and* before = declarations
  and* after = oneofl waits
  and* scenario = fleet
  and* seed = int_bound 1_000 in
  let text = before ^ Generate.print ast ^ after ^ "\n" in
  return (text, scenario, seed)

let print (text, scenario, seed) = Format.asprintf "seed %d@.%a@.%s" seed Scenario.pp scenario text

let is_program source =
  let elaborated = Result.bind (Test_support.Pure_run.read ~file:"random.dol" source) (Elaborate.program ~source_name:"random.dol") in
  Result.is_ok elaborated

let random_runs (source, scenario, seed) =
  if is_program source then is_unchanged ~seed scenario source;
  true

(* {1 Replacements} *)

(* The new program goes on where the old one ends, with a function and a date that the old one does not have. *)
let longer source =
  source ^ "def last(text) { message text }\nexecute condition { now() > 300 }\nlast('longer')\n"

(* When a program is stuck depends on the dates that it has. *)
let is_stuck line = String.ends_with ~suffix:"interrupt an interruption" line

let is_replaced ~seed scenario ~every source =
  let check ~name source' =
    with_temporary (fun ~journal ~picture:_ ->
        let path = temporary ".dol" in
        Fun.protect ~finally:(fun () -> Sys.remove path) (fun () ->
            let channel = open_out_bin path in
            output_string channel source';
            close_out channel;
            let recording = { Recording.nothing with journal = Some journal } in
            let other = Some { path; is_due = (fun n -> n mod every = 0) } in
            let expected = happened (program_of source') scenario ~seed plain in
            let before = !replaced in
            let found = happened (program_of source) scenario ~seed { plain with recording; other } in
            let why = !refused in
            refused := None;
            Option.iter (Alcotest.failf "%s: refused: %s" name) why;
            if !replaced > before && not (List.exists is_stuck expected) then
              match first_difference expected found with
              | None -> ()
              | Some (n, x, y) -> Alcotest.failf "%s: line %d is '%s' instead of '%s'" name n y x))
  in
  check ~name:"replaced by itself" source;
  check ~name:"replaced by a longer one" (longer source)

let random_replacements ((source, scenario, seed), every) =
  if is_program source then is_replaced ~seed scenario ~every source;
  true

(* {1 Programs that a recording changed} *)

let one_vehicle = { Scenario.default with vehicles = [ { (List.hd Scenario.default.vehicles) with id = "u1"; kind = "UUV" } ] }

let known name source = Alcotest.test_case name `Quick (fun () -> is_unchanged ~seed:0 one_vehicle source)

let known_programs =
  [ known "an input that nobody posts"
      "input 'abort'\nonInterrupt task('home')\nv = pick { type 'UUV' }\n\
       execute until { poll abort: true } run condition { poll ready: 1 }\n";
    known "a recruit that cannot be met"
      "v = pick { type 'UUV' }\nexecute recruit { type 'ROV' } then { r -> task('home')[r] }\n" ]

(* The position of a stopped vehicle decides the next allocation. *)
let allocation_after_a_stop =
  let fleet =
    "vehicle 'a', { type 'UUV'; at 41.185, -8.706; speed 20 }\n\
     vehicle 'b', { type 'UUV'; at 41.215, -8.706 }\n"
  in
  let source =
    "a = pick { id 'a' }\nb = pick { id 'b' }\n\
     execute during 100.5.seconds run imcPlan { planName 'north'; locate 41.285, -8.706; goTo() }[a]\n\
     execute imcPlan { planName 'there'; locate 41.205, -8.706; goTo() }\n"
  in
  let check () =
    match Scenario.read ~file:"f.fleet" fleet with
    | Error ds ->
      Alcotest.failf "%a" (Format.pp_print_list (Dolphin_syntax.Diagnostic.pp ~source:fleet)) ds
    | Ok scenario -> is_unchanged ~seed:0 scenario source
  in
  Alcotest.test_case "where a vehicle was stopped" `Quick check

let count = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 20

let replacement_case = QCheck2.Gen.(pair random_case (int_range 1 12))

let enough_replacements () = if !replaced < count then Alcotest.failf "%d replacements are few" !replaced

let enough () = if !compared < 5 * count then Alcotest.failf "%d lines are few" !compared

let () =
  Alcotest.run "recording"
    [ ("known", allocation_after_a_stop :: known_programs);
      ( "random",
        [ Test_support.Property.case "runs are the same with and without recordings" ~count random_case ~print
            random_runs;
          Alcotest.test_case "there was much to compare" `Quick enough ] );
      ( "replaced",
        [ Test_support.Property.case "a run goes on as one of the program that replaces its own" ~count
            replacement_case
            ~print:(fun (case, every) -> Format.sprintf "%s@.every %d" (print case) every)
            random_replacements;
          Alcotest.test_case "there were many replacements" `Quick enough_replacements ] ) ]
