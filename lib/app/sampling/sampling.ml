module Distribution = Dolphin_statistics.Distribution
module Share = Dolphin_statistics.Share
module Workers = Dolphin_processes.Workers

type settings = { seed : int; runs : int option; until : float option; jobs : int; answers : string list }
type stop = All | Known | Interrupted of int list
type ending = { ending : Sampled_run.ending; runs : int; seed : int }
type task = { task : Sampled_run.task; counts : Sampled_run.counts; failing : int }
type handler = { site : Dolphin_semantics.Core.site; ran : int; runs : int }

type t = {
  settings : settings;
  runs : int;
  endings : ending list;
  completed : Distribution.t;
  first : (float * int) option;
  last : (float * int) option;
  tasks : task list;
  handlers : handler list;
  level : float;
  stop : stop;
  seconds : float;
}

let level = 0.95

(* {1 Counting} *)

type tally = {
  mutable count : int;
  endings : (Sampled_run.ending, ending) Hashtbl.t;
  mutable times : (float * int) list;  (* of those that completed, with their seeds *)
  tasks : (Sampled_run.task, task) Hashtbl.t;
  mutable order : Sampled_run.task list;  (* the latest first *)
  handlers : (Dolphin_semantics.Core.site, handler) Hashtbl.t;
}

let nothing () =
  { count = 0; endings = Hashtbl.create 8; times = []; tasks = Hashtbl.create 32; order = [];
    handlers = Hashtbl.create 8 }

let add_task tally (task, (n : Sampled_run.counts)) =
  let before =
    match Hashtbl.find_opt tally.tasks task with
    | Some t -> t
    | None ->
      tally.order <- task :: tally.order;
      { task; counts = { began = 0; ended = 0; failed = 0; stopped = 0 }; failing = 0 }
  in
  let c = before.counts in
  let counts : Sampled_run.counts =
    { began = c.began + n.began; ended = c.ended + n.ended; failed = c.failed + n.failed;
      stopped = c.stopped + n.stopped }
  in
  Hashtbl.replace tally.tasks task
    { task; counts; failing = (before.failing + if n.failed > 0 then 1 else 0) }

let add_handler tally (site, n) =
  let before = Option.value (Hashtbl.find_opt tally.handlers site) ~default:{ site; ran = 0; runs = 0 } in
  Hashtbl.replace tally.handlers site { site; ran = before.ran + n; runs = before.runs + 1 }

let add tally seed (sample : Sampled_run.t) =
  tally.count <- tally.count + 1;
  let { ending; runs; seed = first } =
    Option.value (Hashtbl.find_opt tally.endings sample.ending) ~default:{ ending = sample.ending; runs = 0; seed }
  in
  Hashtbl.replace tally.endings ending { ending; runs = runs + 1; seed = min first seed };
  if sample.ending = Completed then tally.times <- (sample.seconds, seed) :: tally.times;
  List.iter (add_task tally) sample.tasks;
  List.iter (add_handler tally) sample.handlers

let values table = Hashtbl.fold (fun _ x xs -> x :: xs) table []

let by_runs (a : ending) (b : ending) =
  let key (e : ending) = (e.ending <> Sampled_run.Completed, -e.runs, e.seed) in
  compare (key a) (key b)

(* The best of these times; of equal ones that with the least seed. *)
let extreme is_better times =
  let better found (seconds, seed) =
    match found with
    | Some (s, n) when is_better s seconds || (s = seconds && n < seed) -> found
    | Some _ | None -> Some (seconds, seed)
  in
  List.fold_left better None times

let result settings tally ~level ~stop ~seconds =
  { settings; runs = tally.count; endings = List.sort by_runs (values tally.endings);
    completed = Distribution.of_list (List.map fst tally.times);
    first = extreme ( < ) tally.times; last = extreme ( > ) tally.times;
    tasks = List.rev_map (Hashtbl.find tally.tasks) tally.order;
    handlers = List.sort compare (values tally.handlers); level; stop; seconds }

let share (s : t) n = Share.interval ~level:s.level ~hits:n s.runs

(* {1 Looks} *)

(* Whether enough is known after [n] runs, of which it is the [j]-th look. *)
let is_known (settings : settings) tally j =
  match settings.until with
  | None -> false
  | Some until ->
    let level = Share.level_of_look ~level j in
    Share.half_width (Share.interval ~level ~hits:(List.length tally.times) tally.count) <= until

type course = Counting of int | Stopped of stop * float  (* before this look; after one of this level *)

(* The action after a run was counted. The last run is a look too. *)
let after_run (settings : settings) tally j =
  let is_last = Some tally.count = settings.runs in
  let at_level = match settings.until with None -> level | Some _ -> Share.level_of_look ~level j in
  if tally.count = Share.look j || is_last then
    if is_known settings tally j then Stopped (Known, at_level)
    else if is_last then Stopped (All, at_level)
    else Counting (j + 1)
  else Counting j

(* {1 Runs} *)

exception Refused of Error.t

(* Runs count in the order of their seeds, so that nothing depends on which process was faster; [waiting] is those that
   came before their turn. *)
let rec count_ready ~each (settings : settings) tally waiting j =
  let seed = settings.seed + tally.count in
  match Hashtbl.find_opt waiting seed with
  | None -> Counting j
  | Some (Error e) -> raise (Refused e)
  | Some (Ok sample) ->
    Hashtbl.remove waiting seed;
    add tally seed sample;
    each ~seed sample;
    (match after_run settings tally j with
     | Counting j -> count_ready ~each settings tally waiting j
     | Stopped _ as stopped -> stopped)

(* Those that are known after others that are not: an interruption leaves out those that take long. *)
let count_rest (settings : settings) tally waiting under_way j =
  Hashtbl.iter (fun seed -> function Ok sample -> add tally seed sample | Error _ -> ()) waiting;
  let level = match settings.until with None -> level | Some _ -> Share.level_of_look ~level j in
  (Interrupted under_way, level)

let follow ~interrupted ~progress ~each settings workers tally =
  let waiting = Hashtbl.create 1_000 in
  let rec go j =
    if interrupted () then count_rest settings tally waiting (Workers.under_way workers) j
    else begin
      List.iter (fun (seed, result) -> Hashtbl.replace waiting seed result) (Workers.next workers ~timeout:0.2);
      let course = count_ready ~each settings tally waiting j in
      progress tally.count;
      match course with Counting j -> go j | Stopped (stop, level) -> (stop, level)
    end
  in
  go 1

let start_workers ~jobs ~first ?last sample =
  match Workers.start ~jobs ~first ?last sample with
  | workers -> Ok workers
  | exception Unix.Unix_error (code, call, _) ->
    let why = Printf.sprintf "%s: %s" call (Unix.error_message code) in
    Error (Error.Unavailable (Printf.sprintf "the %d processes that simulate runs cannot be started: %s" jobs why))

let run ~interrupted ~progress ~each (settings : settings) program fleet =
  let began = Unix.gettimeofday () in
  let last = Option.map (fun n -> settings.seed + n - 1) settings.runs in
  let jobs = match settings.runs with Some n -> max 1 (min n settings.jobs) | None -> settings.jobs in
  let sample seed = Sampled_run.run ~seed ~answers:settings.answers program fleet in
  let tally = nothing () in
  let follow workers =
    Fun.protect
      ~finally:(fun () -> Workers.stop workers)
      (fun () -> follow ~interrupted ~progress ~each settings workers tally)
  in
  match
    Result.bind (start_workers ~jobs ~first:settings.seed ?last sample) @@ fun workers ->
    Ok (follow workers)
  with
  | Ok (stop, level) -> Ok (result settings tally ~level ~stop ~seconds:(Unix.gettimeofday () -. began))
  | Error e | (exception Refused e) -> Error e
  | exception Workers.Died { number = seed; _ } ->
    Error (Error.Unavailable (Printf.sprintf "the process that simulated the run with the seed %d has died" seed))

let count ~answers read =
  let began = Unix.gettimeofday () in
  let tally = nothing () and first = ref None in
  let add ~seed sample =
    if !first = None then first := Some seed;
    add tally seed sample
  in
  let result () =
    let settings =
      { seed = Option.value !first ~default:0; runs = Some tally.count; until = None; jobs = 1; answers } in
    result settings tally ~level ~stop:All ~seconds:(Unix.gettimeofday () -. began)
  in
  Result.map result (read ~add)
