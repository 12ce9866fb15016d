open Dolphin_semantics
open Dolphin_runtime
open Dolphin_display
open Lwt.Infix
module Diagnostic = Dolphin_syntax.Diagnostic
module Location = Dolphin_syntax.Location
module Replay = Dolphin_trace.Replay
module Simulator = Dolphin_platform_sim.Simulator
module Udp_platform = Dolphin_platform_imc.Udp_platform

type settings = {
  program : Program_file.t;
  scenario : Dolphin_scenario.Scenario.t;
  network : Udp_platform.options option;
  speed : float option;
  seed : int;
  answers : string list;
  supplier : string option;
  supplier_timeout : float option;
  record : Record.settings;
  resumed : Resumed.t option;
}

(* {1 What is seen} *)

let is_live () =
  let dumb = match Sys.getenv_opt "TERM" with None | Some ("" | "dumb") -> true | Some _ -> false in
  Unix.isatty Unix.stdout && not dumb

(* The log on [screen] and its board, as an observer. [is_stuck] tells whether an interruption is the driver's, of a
   program that is stuck. *)
let observe screen log board ~is_stuck : Observer.t =
  let print lines = List.iter (Screen.print screen) lines in
  let transition ~time ~cause:_ s =
    board := Status.transition !board ~time s;
    let next, lines = Log.transition ~stuck:(is_stuck ()) !log ~time s in
    log := next;
    print lines
  in
  let news ~time state =
    board := Status.news !board ~time state;
    let next, lines = Log.news !log ~time state in
    log := next;
    print lines;
    Screen.changed screen
  in
  { transition; news }

(* {1 What went wrong} *)

let tell_fault s (fault : Fault.t) =
  let at = Option.value (Fault.location s.program.program fault) ~default:Location.none in
  Report.diagnostics ~source:s.program.source [ Diagnostic.error at fault.message ]

let tell_stuck s residual =
  let guard (c : Core.closure) =
    let at = s.program.program.locations.(c.lambda.lambda_site) in
    Diagnostic.error at "the program is stuck: nothing can make this condition true any more"
  in
  let in_text a b = Diagnostic.compare a b in
  match List.sort_uniq in_text (List.map guard (Driver.guards residual)) with
  | [] -> Report.complain "the program is stuck: nothing more can happen"
  | found -> Report.diagnostics ~source:s.program.source found

let status s : Driver.outcome -> Exit_status.t = function
  | Ended Completed -> Done
  | Ended (Halted _) -> Failed
  | Ended (Failed fault) -> tell_fault s fault; Failed
  | Ended Interrupted -> Interrupted
  | Stuck residual -> tell_stuck s residual; Failed

let in_trouble why : Exit_status.t =
  Report.complain why;
  Platform_trouble

(* That nobody reads the log any more is no trouble: whoever did has gone, as [head] does. *)
let trouble_of_log : Unix.error -> string option = function
  | EPIPE | EIO | EBADF -> None
  | error -> Some (Printf.sprintf "the log cannot be written: %s" (Unix.error_message error))

(* {1 The run} *)

(* What a host remembers died with it, and only its people can know what that was. *)
let start_host s =
  let replies = match s.resumed with Some r -> History.replies r.past.history | None -> [] in
  let calls = List.length (List.filter (fun (_, reply) -> reply <> None) replies) in
  match s.supplier with
  | None -> Ok None
  | Some command ->
    if calls > 0 then
      Report.complain
        (Printf.sprintf "the supplier is started anew: %s that it has answered in this run %s not made again"
           (Report.count calls "call") (if calls = 1 then "is" else "are"));
    Result.map Option.some (Host.start ?timeout:s.supplier_timeout ~calls command)

type 'p fleet = {
  platform : 'p;
  more_lines : unit -> string list;  (* for the board, below its vehicles *)
  told : (string -> unit) ref;  (* is told of what is unusual *)
  news : World.vehicle_state list;  (* since the console died, if the run is gone on with *)
}

type platform = Platform : (module Platform.S with type t = 'p) * 'p fleet -> platform

let nothing_more () = []
let simulated_fleet ?(news = []) platform = { platform; more_lines = nothing_more; told = ref ignore; news }

(* The simulated fleet passes its time at once, or as a clock does. *)
let simulated s =
  let { seed; scenario; _ } = s in
  let again (platform, news) = simulated_fleet ~news platform in
  match s.speed, s.resumed with
  | None, None -> Ok (Platform ((module Simulator.Virtual), simulated_fleet (Simulator.Virtual.create ~seed scenario)))
  | Some speed, None ->
    Ok (Platform ((module Simulator.Paced), simulated_fleet (Simulator.Paced.create ~speed ~seed scenario)))
  | None, Some { past; _ } ->
    Result.map
      (fun made -> Platform ((module Simulator.Virtual), again made))
      (Simulator.Virtual.create_again ~seed scenario past.history)
  | Some speed, Some { past; _ } ->
    Result.map
      (fun made -> Platform ((module Simulator.Paced), again made))
      (Simulator.Paced.create_again ~speed ~seed scenario past.history)

(* How far vehicles are with their plans, by their own estimate. *)
let estimates network () =
  let line (system : Dolphin_platform_imc.Station.system) =
    match Udp_platform.progress network system.state.id with
    | Some { plan; share = Some share; remaining; _ } ->
      let left = match remaining with Some t -> Printf.sprintf ", %s left" (Wording.clock t) | None -> "" in
      let name = Wording.harmless system.state.id and plan = Wording.harmless plan in
      Some (Printf.sprintf "         %s: %.0f%% of %s%s" name (100. *. share) plan left)
    | Some { share = None; _ } | None -> None
  in
  List.filter_map line (Udp_platform.systems network)

(* What the time of a run is now whose console died: it went on. Clocks may have been set meanwhile, but runs never go
   back. *)
let time_of_run ({ past; _ } : Resumed.t) =
  let time, at = past.clock in
  let passed = Option.map (fun began -> Unix.gettimeofday () -. began) (Dolphin_trace.Header.of_utc at) in
  Float.max (Replay.time past.replay) (time +. Option.value passed ~default:0.)

(* Nothing is heard of vehicles until they are heard again. *)
let unheard resumed =
  let lose (state : World.vehicle_state) = { state with connected = false } in
  let world (r : Resumed.t) = List.map lose (World.vehicles (Replay.world r.past.replay)) in
  Option.fold resumed ~none:[] ~some:world

let open_platform s ~keep ~sync =
  match s.network with
  | None -> simulated s
  | Some options ->
    let told = ref ignore in
    let note vehicle text = !told (Printf.sprintf "%s: %s" vehicle text) in
    let options = { options with note; keep; sync } in
    let opened =
      match s.resumed with
      | None -> Udp_platform.open_ options
      | Some r -> Udp_platform.open_again options ~time:(time_of_run r) r.past.history
    in
    let fleet network = { platform = network; more_lines = estimates network; told; news = unheard s.resumed } in
    Result.map (fun network -> Platform ((module Udp_platform), fleet network)) opened

let beginning resumed news : Driver.beginning option =
  let of_past ({ past; _ } : Resumed.t) : Driver.beginning =
    let replay = past.replay in
    { configuration = Replay.configuration replay; world = Replay.world replay; news; pending = past.pending }
  in
  Option.map of_past resumed

let drive s record host (Platform ((module P), { platform; more_lines; told; news })) =
  let last_words =
    Option.map (fun _ -> "interrupted twice: ended at once; vehicles that were not told to stop yet run on") s.network
  in
  let interruption = Interruption.make ?last_words () in
  let live = is_live () in
  let log_trouble = ref None in
  let on_closed error =
    log_trouble := trouble_of_log error;
    Interruption.interrupt interruption
  in
  let screen = Screen.make ~live ~on_closed Unix.stdout in
  let log = ref (match s.resumed with Some r -> r.log | None -> Log.start) in
  let board = ref (match s.resumed with Some r -> r.board | None -> Status.start) in
  (* The driver interrupts stuck programs by itself. *)
  let is_stuck () = not (Interruption.happened interruption) in
  let time () = P.now platform in
  told := (fun text -> Screen.print screen (Log.remark !log ~time:(time ()) text));
  Screen.show screen (fun () -> match Status.lines !board with [] -> [] | lines -> lines @ more_lines ());
  let shown : Questions.shown =
    { ask = (fun prompt -> Screen.ask screen (Log.question !log ~time:(time ()) prompt));
      answered = Screen.answered screen;
      refused = (fun why -> Screen.print screen (Log.remark !log ~time:(time ()) ("cannot take this answer: " ^ why))) }
  in
  let past = Option.fold s.resumed ~none:[] ~some:(fun (r : Resumed.t) -> r.past.history) in
  let run () =
    Driver.run (module P) platform ~always_telemetry:(live || Record.is_wanted s.record)
      ~observer:(Observer.both (Record.observer record) (observe screen log board ~is_stuck))
      ~host:(match host with Some host -> Host.call host | None -> Replies.call ~past s.scenario)
      ?beginning:(beginning s.resumed news)
      ~console:(Questions.console shown ~answered:(History.answers past) ~answers:s.answers ~scenario:s.scenario)
      ~interruption:(Interruption.promise interruption) s.program.program
  in
  let close () =
    Screen.close screen;
    match host with None -> Lwt.return_unit | Some host -> Host.close host
  in
  let finish outcome =
    let was_stuck = Option.fold s.resumed ~none:false ~some:(fun (r : Resumed.t) -> Replay.was_stuck r.past.replay) in
    let is_stuck = match (outcome : Driver.outcome) with Stuck _ -> true | Ended _ -> was_stuck in
    match Record.finish record ~time:(time ()) ~stuck:is_stuck, !log_trouble with
    | Error why, _ | Ok (), Some why -> in_trouble why
    | Ok (), None -> status s outcome
  in
  let broken = function
    | Record.Broken why -> Lwt.return (in_trouble (why ^ "; the run was ended as by Ctrl-C"))
    | Unix.Unix_error (error, call, _) ->
      Lwt.return (in_trouble (Printf.sprintf "trouble of the platform: %s: %s" call (Unix.error_message error)))
    | error -> Lwt.fail error
  in
  Lwt_main.run (Lwt.catch (fun () -> Lwt.finalize run close >|= finish) broken)

let run s =
  Sys.set_signal Sys.sigpipe Signal_ignore;
  let program = s.program.program in
  let record =
    match s.resumed with
    | None -> Record.start s.record program
    | Some resumed ->
      let source = Dolphin_trace.Header.source ~path:s.program.path s.program.source in
      Record.resume s.record program ~source resumed
  in
  match record with
  | Error why -> in_trouble why
  | Ok record -> (
      let keep ~time vehicle memo = Record.note record ~time ~vehicle memo in
      match open_platform s ~keep ~sync:(Record.sync record) with
      | Error why -> in_trouble why
      | Ok platform -> (
          match start_host s with
          | Ok host -> drive s record host platform
          | Error why -> in_trouble ("the supplier cannot be started: " ^ why)))
