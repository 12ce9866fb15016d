open Dolphin_semantics

type clock = Seconds | Steps
type ending = Done | Failed of string | Stopped | Unfinished
type task = { plan : string; from : float; until : float; ending : ending; way : Entry.way option }
type sample = { time : float; position : Dolphin_geo.Position.t; battery : float option }
type span = { from : float; until : float }

type vehicle = {
  id : string;
  kind : string;
  tasks : task list;
  held : span list;
  silent : span list;
  samples : sample list;
}

type activity =
  | Posted of string
  | Consumed of string
  | Said of string
  | Asked of string
  | Erred of string

type t = {
  clock : clock;
  header : Header.t option;
  duration : float;
  vehicles : vehicle list;
  activities : (float * activity) list;
  ending : Request.ending option;
  layers : Layer.t list;
}

(* A vehicle, as far as the journal has been read; lists are latest first. *)
type vehicle_so_far = {
  mutable its_kind : string;
  mutable ended : task list;
  mutable running : (string * float * Entry.way option) option;  (* with the time of its start *)
  mutable spans_held : span list;
  mutable held_from : float option;
  mutable spans_silent : span list;
  mutable silent_from : float option;
  mutable seen : sample list;
  mutable kept : int;  (* how many samples that is *)
  mutable apart : float;  (* seconds between samples, at least *)
}

type builder = {
  its_clock : clock;
  most_samples : int;  (* of a vehicle *)
  by_id : (string, vehicle_so_far) Hashtbl.t;
  mutable picked : string list;  (* latest first *)
  mutable its_header : Header.t option;
  mutable now : float;
  mutable cause : Event.t option;  (* of the next transition *)
  mutable activities_so_far : (float * activity) list;
  mutable its_ending : Request.ending option;
}

(* No picture shows more samples than that: of a long run, only some are kept, evenly. *)
let create ?(clock = Seconds) ?(most_samples = 4096) () =
  { its_clock = clock; most_samples; by_id = Hashtbl.create 16; picked = []; its_header = None; now = 0.; cause = None;
    activities_so_far = []; its_ending = None }

let vehicle b v =
  match Hashtbl.find_opt b.by_id v with
  | Some a -> a
  | None ->
    let a =
      { its_kind = ""; ended = []; running = None; spans_held = []; held_from = None; spans_silent = [];
        silent_from = None; seen = []; kept = 0; apart = 0. }
    in
    Hashtbl.replace b.by_id v a;
    a

(* {1 What happens to vehicles} *)

let end_task b v ending =
  let a = vehicle b v in
  match a.running with
  | None -> ()
  | Some (plan, from, way) ->
    a.running <- None;
    a.ended <- { plan; from; until = b.now; ending; way } :: a.ended

let start_task b v plan way =
  end_task b v Stopped;
  (vehicle b v).running <- Some (plan, b.now, way)

let hold b v =
  let a = vehicle b v in
  if not (List.mem v b.picked) then b.picked <- v :: b.picked;
  if a.held_from = None then a.held_from <- Some b.now

let let_go b v =
  let a = vehicle b v in
  Option.iter (fun from -> a.spans_held <- { from; until = b.now } :: a.spans_held) a.held_from;
  a.held_from <- None

(* The latest sample always stays, so that the last one does; the one before it goes if it is too near to those around
   it. *)
let keep a sample =
  match a.seen with
  | last :: (before :: _ as others) when sample.time -. last.time < a.apart && last.time -. before.time < a.apart ->
    a.seen <- sample :: others
  | seen ->
    a.seen <- sample :: seen;
    a.kept <- a.kept + 1

let thin_out b a =
  if a.kept > b.most_samples then begin
    let halve (i, kept) sample = (i + 1, if i mod 2 = 0 then sample :: kept else kept) in
    let count, reversed = List.fold_left halve (0, []) a.seen in
    a.seen <- List.rev reversed;
    a.kept <- (count + 1) / 2;
    match a.seen, reversed with
    | last :: _, first :: _ -> a.apart <- (last.time -. first.time) /. float_of_int a.kept
    | _, _ -> ()
  end

let see b (s : World.vehicle_state) =
  let a = vehicle b s.id in
  a.its_kind <- s.kind;
  if s.connected then begin
    Option.iter (fun from -> a.spans_silent <- { from; until = b.now } :: a.spans_silent) a.silent_from;
    a.silent_from <- None;
    keep a { time = b.now; position = s.position; battery = s.battery };
    thin_out b a
  end
  else if a.silent_from = None then a.silent_from <- Some b.now

(* {1 What the program does} *)

let errors (s : Step.t) (cause : Event.t option) =
  match cause with
  | Some (Failed { vehicle; why }) -> [ Printf.sprintf "%s: %s" vehicle why ]
  | Some
      ( Done _ | Timer _ | Confirmation _ | No_confirmation _ | Recruited _ | Answer _ | No_answer _ | Reply _
      | No_reply _ | Input _
      | Interruption _ )
  | None ->
    let is_broken = String.length s.label > 7 && String.sub s.label 0 7 = "broken(" in
    if is_broken then [ String.sub s.label 7 (String.length s.label - 8) ] else []

let take b (s : Step.t) ways =
  let note activity = b.activities_so_far <- (b.now, activity) :: b.activities_so_far in
  (match b.cause with
   | Some (Done v) -> end_task b v Done
   | Some (Failed { vehicle; why }) -> end_task b vehicle (Failed why)
   | Some
       ( Timer _ | Confirmation _ | No_confirmation _ | Recruited _ | Answer _ | No_answer _ | Reply _ | No_reply _
       | Input _
       | Interruption _ )
   | None -> ());
  List.iter (fun text -> note (Erred text)) (errors s b.cause);
  b.cause <- None;
  List.iter (fun pair -> note (Consumed pair)) s.consumed;
  List.iter (fun pair -> note (Posted pair)) s.posted;
  let request : Request.t -> unit = function
    | Start { vehicle; plan } -> start_task b vehicle plan (List.assoc_opt vehicle ways)
    | Stop v -> end_task b v Stopped
    | Bind vs -> List.iter (hold b) vs
    | Release vs -> List.iter (let_go b) vs
    | Say text -> note (Said text)
    | Ask prompt | Put_question { prompt; _ } -> note (Asked prompt)
    | Set_timer _ | Cancel_timer _ | Withdraw_question _ | Look_for _ | Set_connection_timeout _ | Call _ | End _ -> ()
  in
  List.iter request s.requests

let add b (entry : Entry.t) =
  b.now <- Float.max b.now (Entry.time entry);
  match entry with
  | Header header -> b.its_header <- Some header
  | Vehicle { state; _ } -> see b state
  | Event { event; _ } -> b.cause <- Some event
  | Transition { step; ways; _ } -> take b step ways
  | Partial _ | Label _ | Note _ | Act _ | Resumed _ -> ()
  | End { ending; _ } -> b.its_ending <- Some ending

(* {1 The end} *)

let finish b =
  let until = b.now in
  let spans ended from = List.rev (Option.fold ~none:ended ~some:(fun from -> { from; until } :: ended) from) in
  let finished v =
    let a = vehicle b v in
    let last = Option.map (fun (plan, from, way) -> { plan; from; until; ending = Unfinished; way }) a.running in
    { id = v;
      kind = a.its_kind;
      tasks = List.rev (Option.to_list last @ a.ended);
      held = spans a.spans_held a.held_from;
      silent = spans a.spans_silent a.silent_from;
      samples = List.rev a.seen }
  in
  { clock = b.its_clock;
    header = b.its_header;
    duration = until;
    vehicles = List.rev_map finished b.picked;
    activities = List.rev b.activities_so_far;
    ending = b.its_ending;
    layers = [] }

(* {1 Asking} *)

let moment t time =
  match t.clock with Seconds -> Phrase.time time | Steps -> Printf.sprintf "step %.0f" time

let runs v =
  let was_silent a b =
    List.exists (fun (s : span) -> s.from >= a.time && s.until <= b.time && s.until > s.from) v.silent
  in
  let add runs sample =
    match runs with
    | (last :: _ as run) :: others when not (was_silent last sample) -> (sample :: run) :: others
    | runs -> [ sample ] :: runs
  in
  List.rev_map List.rev (List.fold_left add [] v.samples)

let working v =
  let rec walk found samples (tasks : task list) =
    match samples, tasks with
    | [], _ -> List.rev found
    | s :: _, t :: tasks when t.until <= s.time && (t.until < s.time || tasks <> []) -> walk found samples tasks
    | s :: samples, t :: _ when t.from <= s.time -> walk ((s, Some t) :: found) samples tasks
    | s :: samples, tasks -> walk ((s, None) :: found) samples tasks
  in
  walk [] v.samples v.tasks

let is_invented t (task : task) =
  match t.header, task.way with
  | Some { platform = "sim"; _ }, Some By_name -> true
  | (Some _ | None), _ -> false

let places v =
  let rec walk last samples (tasks : task list) found =
    match samples, tasks with
    | s :: samples, t :: _ when s.time <= t.from +. 1e-6 -> walk (Some s.position) samples tasks found
    | samples, t :: tasks -> walk last samples tasks (match last with Some p -> (t, p) :: found | None -> found)
    | _, [] -> List.rev found
  in
  walk None v.samples v.tasks []
