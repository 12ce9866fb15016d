open Dolphin_semantics
open Dolphin_environment
open Dolphin_runtime
open Dolphin_trace

(* A line of the journal, as far as it bears on the rest of the run. *)
type line = Took of Transition.event option * Transition.t | Heard of Core.vehicle * bool

type t = {
  path : string;
  past : Resumption.t;
  configuration : Configuration.t;
  time : float;
  lines : (float * line) list;
}

(* An event whose transition was not written has happened too. *)
let finish program { Resumed.path; past; _ } ~lines =
  let c = Replay.configuration past.replay and world = Replay.world past.replay in
  (* It is the last of the history. *)
  let time =
    match past.pending, List.rev past.history with
    | Some _, { History.time; _ } :: _ -> time
    | Some _, [] | None, _ -> Replay.time past.replay
  in
  let accepted event = Result.to_option (Transition.accept program world c event) in
  let configuration, lines =
    match past.pending, Option.bind past.pending accepted with
    | Some event, Some (t : Transition.t) -> (t.next, (time, Took (Some event, t)) :: lines)
    | None, _ | Some _, None -> (c, lines)
  in
  match configuration.control with
  | Ended _ -> Error (Error.Bad_input (path ^ ": this run is over"))
  | Script _ | Waiting _ | Executing _ -> Ok { path; past; configuration; time; lines = List.rev lines }

let ( let* ) = Result.bind

let read (program : Program_file.t) path =
  let lines = ref [] in
  let add time line = lines := (time, line) :: !lines in
  let tell (entry : Entry.t) replay =
    (match entry with Vehicle { time; state } -> add time (Heard (state.id, state.connected)) | _ -> ());
    Option.iter (fun (cause, t) -> add (Replay.time replay) (Took (cause, t))) (Replay.latest replay)
  in
  let* resumed = Resumed.read ~changed:true ~tell program path in
  finish program.program resumed ~lines:!lines

let fleet p ~program ~named =
  match named, p.past.header.fleet with
  | Some _, _ -> Fleet_file.load named
  | None, Some source -> Fleet_file.load (Some source.path)
  | None, None when p.past.header.platform = "sim" -> Fleet_file.load None
  | None, None -> Fleet_file.load_for ~program None

let load path ~set ~fleet:named ~journal =
  let* journal = Run_folder.journal journal in
  let set = if set = [] then Option.value (Journal_file.settings journal) ~default:[] else set in
  let* program = Program_file.load ~set path in
  let* present = read program journal in
  let* fleet = fleet present ~program:path ~named in
  let fleet = Fleet_file.beginning present.past.header.begins fleet in
  let* program = Program_file.within fleet program in
  Ok (present, program, fleet)

(* {1 The state} *)

let known p = World.vehicles (Replay.world p.past.replay)
let out_of_contact p = List.filter (fun (s : World.vehicle_state) -> not s.connected) (known p)

let start p options program =
  let count (c, e) (_, line) =
    match line with
    | Heard _ -> (c, e)
    | Took (cause, (t : Transition.t)) ->
      (t.next, Option.fold cause ~none:e ~some:(fun event -> Environment.after options program c event e))
  in
  let _, counted = List.fold_left count (Configuration.initial program, Environment.initial) p.lines in
  let lost = List.map (fun (s : World.vehicle_state) -> s.id) (out_of_contact p) in
  let options, outside = Environment.without_contact lost (options, counted) in
  (options, (p.configuration, outside))

let world p scenario = Scenario_world.seen scenario (Replay.world p.past.replay)

(* {1 Time} *)

let milliseconds time = Option.value (Dolphin_time.Bounds.milliseconds time) ~default:0

let recorded p (options : Dolphin_time.Clocked.options) =
  let open Dolphin_time in
  let take r (time, line) =
    let date = milliseconds time in
    match line with
    | Heard (v, connected) -> Dated_run.heard r ~date v connected
    | Took (on, t) -> fst (Dated_run.transition r ~date ~on t)
  in
  List.fold_left take (Dated_run.start ~tolerance:0 options) p.lines

let running p options = Dolphin_time.Dated_run.running (recorded p options)

let timed p (options : Dolphin_time.Clocked.options) =
  let open Dolphin_time in
  let recorded = recorded p options in
  let environment, (_, outside) = start p options.environment options.program in
  let seen = List.map (fun (s : World.vehicle_state) -> (s.id, s.position)) (known p) in
  let date = milliseconds p.time in
  let options, state = Dated_run.onwards recorded ~outside ~date ~seen in
  ({ options with environment }, { Timed_analysis.state; date })

(* {1 Texts} *)

let remarks p (program : Program_file.t) (fleet : Fleet_file.t) =
  let hash (source : Header.source) = source.hash in
  let header = p.past.header in
  let program_changed = hash (Program_file.header program) <> hash header.program in
  let fleet_changed =
    match Fleet_file.header fleet, header.fleet with
    | Some now, Some before -> hash now <> hash before
    | None, None -> false
    | Some _, None | None, Some _ -> true
  in
  let if_so holds text = if holds then [ text ] else [] in
  if_so program_changed
    (program.path ^ ": this program is not the one that the run began with; the run so far is the beginning of a run \
                     of this one, too")
  @ if_so fleet_changed "the fleet is not the one that the run began with, or it has changed since"
  @ List.map
    (fun (s : World.vehicle_state) -> s.id ^ " is out of contact: its tasks may fail, and a pick may miss it")
    (out_of_contact p)

let pp ppf p =
  Format.fprintf ppf "from %s of %s, after %s" (Phrase.time p.time) p.path
    (Phrase.count (Replay.transitions p.past.replay) "transition")

let to_json p : Yojson.Safe.t =
  `Assoc
    [ ("journal", `String p.path); ("time", `Float p.time);
      ("transitions", `Int (Replay.transitions p.past.replay)) ]
