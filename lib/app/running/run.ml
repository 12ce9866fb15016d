open Dolphin_plans
open Dolphin_semantics
open Dolphin_runtime
open Dolphin_trace
open Lwt.Infix
module Diagnostic = Dolphin_syntax.Diagnostic
module Simulator = Dolphin_platform_sim.Simulator
module Udp_platform = Dolphin_platform_imc.Udp_platform

type settings = {
  network : Udp_platform.options option;
  adapters : string list;
  speed : float option;
  seed : int option;
  answers : string list;
  people : bool;
  supplier : string option;
  supplier_timeout : float option;
  socket : bool;
  recording : Recording.settings;
}

let simulated =
  { network = None; adapters = []; speed = None; seed = None; answers = []; people = false;
    supplier = None; supplier_timeout = None;
    socket = false; recording = Recording.nothing }

let choice (s : settings) : Networks.choice = { imc = s.network; adapters = s.adapters }
let is_simulated s = not (Networks.is_any (choice s))

type estimate = Networks.estimate = {
  vehicle : string;
  plan : string;
  share : float;
  remaining : float option;
}

type view = {
  now : unit -> float;
  estimates : unit -> estimate list;
  post : string -> Core.value -> bool Lwt.t;
  questions : unit -> string list;
  replace : ?set:(string * string) list -> ?hash:string -> string -> (float, Replacement.refusal) result Lwt.t;
  acted : Act.t -> (unit, string) result;
}

type front = {
  replayed : Entry.t -> Replay.t -> unit;
  notice : string -> unit;
  opened : view -> unit;
  remark : string -> unit;
  replaced : Program_file.t -> Replay.t -> unit;
  observer : Observer.t;
  person : Questions.person;
  wants_telemetry : bool;
}

let unattended =
  { replayed = (fun _ _ -> ()); notice = ignore; opened = ignore; remark = ignore; replaced = (fun _ _ -> ());
    observer = Observer.nobody;
    person = Questions.nobody; wants_telemetry = false }

(* {1 Outcomes} *)

let explain (program : Program_file.t) : Driver.outcome -> Error.t option = function
  | Ended (Completed | Halted _ | Interrupted) -> None
  | Ended (Failed fault) ->
    Some (Error.Bad_text { source = program.source; found = [ Program_file.diagnostic program fault ] })
  | Spins site ->
    let message =
      "the program is stuck in rounds that begin here: they follow each other, and none waits for anything that happens"
    in
    let found = [ Program_file.diagnostic program (Fault.make site message) ] in
    Some (Error.Bad_text { source = program.source; found })
  | Stuck residual -> (
      let guard (c : Core.closure) =
        let at = program.program.locations.(c.lambda.lambda_site) in
        Diagnostic.error at "the program is stuck: nothing can make this condition true any more"
      in
      match List.sort_uniq Diagnostic.compare (List.map guard (Driver.guards residual)) with
      | [] -> Some (Error.Bad_input "the program is stuck: nothing more can happen")
      | found -> Some (Error.Bad_text { source = program.source; found }))

(* {1 Debug log} *)

let source = Logs.Src.create "dolphin.app" ~doc:"What runs are started with"

module Log = (val Logs.src_log source : Logs.LOG)

let log_start (settings : settings) (program : Program_file.t) (fleet : Fleet_file.t) ~seed =
  let option name = Fmt.option (fun ppf text -> Fmt.pf ppf ", %s %s" name text) in
  Log.info (fun m ->
      m "program %s, fleet %s, seed %d%a%a" program.path
        (Option.value fleet.path ~default:"built in")
        seed (option "journal") settings.recording.journal (option "supplier") settings.supplier)

(* {1 What a run needs} *)

(* One run: its arguments, and the run that it resumes. *)
type t = {
  front : front;
  settings : settings;
  seed : int;
  run : string option;  (* its identity, that copies of its journal share *)
  program : Program_file.t;
  fleet : Fleet_file.t;
  resumed : Resumed.t option;
  fenced : Fence_guard.past option;  (* of the run that it resumes, if it has fences *)
}

let history r = Option.fold r.resumed ~none:[] ~some:(fun (resumed : Resumed.t) -> resumed.past.history)

(* The memory of a host died with it, and only its authors can know its content. *)
let start_host r =
  let is_answered (_, reply) = reply <> None in
  let calls = List.length (List.filter is_answered (History.replies (history r))) in
  match r.settings.supplier with
  | None -> Ok None
  | Some command ->
    if calls > 0 then
      r.front.notice
        (Printf.sprintf "the supplier is started again: %s that it has answered in this run %s not made again"
           (Dolphin_trace.Phrase.count calls "call") (if calls = 1 then "is" else "are"));
    (match Host.start ?timeout:r.settings.supplier_timeout ~calls command with
     | Ok host -> Ok (Some host)
     | Error why -> Error (Error.Unavailable ("the supplier cannot be started: " ^ why)))

(* The platform's part of it, without plans that were not started because of a fence. *)
let past_of_platform r =
  Option.fold r.fenced ~none:(history r) ~some:(fun (past : Fence_guard.past) -> past.history)

let close_host = Option.fold ~none:Lwt.return_unit ~some:Host.close

let header r (fleet : Fleet_file.t) : Header.t =
  { program = Program_file.header r.program;
    fleet = Fleet_file.header fleet;
    platform = (if is_simulated r.settings then "sim" else Networks.name (choice r.settings));
    order = (if is_simulated r.settings then Simulator.Virtual.order else Udp_platform.order);
    seed = r.seed;
    speed = r.settings.speed;
    run = r.run;
    started = Recording.utc_now ();
    fences = Dolphin_plans.Fences.list r.program.program.fences;
    place = r.program.program.place;
    begins = r.program.program.begins }

(* {1 Platforms} *)

type 'p fleet = {
  platform : 'p;
  estimates : unit -> estimate list;
  leave : unit -> unit Lwt.t;  (* closes it and stops nothing *)
  news : World.vehicle_state list;  (* of vehicles, since the console died *)
}

type platform = Platform : (module Platform.S with type t = 'p) * 'p fleet -> platform

(* The simulated fleet passes its time at once, or as a clock does. *)
let open_simulated r =
  let fresh platform = { platform; estimates = (fun () -> []); leave = Lwt.return; news = [] } in
  let rebuilt (platform, news) = { (fresh platform) with news } in
  let seed = r.seed and scenario = r.fleet.scenario in
  let virtual_ fleet = Platform ((module Simulator.Virtual), fleet) in
  let paced fleet = Platform ((module Simulator.Paced), fleet) in
  match r.settings.speed, r.resumed with
  | None, None -> Ok (virtual_ (fresh (Simulator.Virtual.create ~seed scenario)))
  | Some speed, None -> Ok (paced (fresh (Simulator.Paced.create ~speed ~seed scenario)))
  | None, Some _ ->
    let made = Simulator.Virtual.create_again ~seed scenario (past_of_platform r) in
    Result.map (fun made -> virtual_ (rebuilt made)) made
  | Some speed, Some _ ->
    let made = Simulator.Paced.create_again ~speed ~seed scenario (past_of_platform r) in
    Result.map (fun made -> paced (rebuilt made)) made

(* The present time of a run whose console died: it went on. Clocks may have been set meanwhile, but runs never go
   back. *)
let time_of_run ({ past; _ } : Resumed.t) =
  let time, at = past.clock in
  let passed = Option.map (fun began -> Unix.gettimeofday () -. began) (Header.of_utc at) in
  Float.max (Replay.time past.replay) (time +. Option.value passed ~default:0.)

(* Nothing is heard of vehicles until they are heard again. *)
let unheard (resumed : Resumed.t) =
  let lose (state : World.vehicle_state) = { state with connected = false } in
  List.map lose (World.vehicles (Replay.world resumed.past.replay))

let open_network r recording =
  let note vehicle text = r.front.remark (match vehicle with Some v -> v ^ ": " ^ text | None -> text) in
  let surroundings : Networks.surroundings =
    { program = Filename.basename r.program.path; run = Option.value r.run ~default:""; note;
      keep = (fun ~time vehicle json -> Recording.note recording ~time ~vehicle json);
      sync = Recording.sync recording;
      past = Option.map (fun resumed -> (time_of_run resumed, past_of_platform r)) r.resumed }
  in
  let news = Option.fold r.resumed ~none:[] ~some:unheard in
  let fleet ({ part = Part (platform, network); estimates; leave } : Networks.opened) =
    Platform (platform, { platform = network; estimates; leave; news })
  in
  Networks.open_ (choice r.settings) surroundings >|= Result.map fleet

let open_platform r recording =
  let opened =
    if is_simulated r.settings then Lwt.return (open_simulated r) else open_network r recording in
  opened >|= Result.map_error (fun why -> Error.Unavailable why)

(* {1 Picks that came too early} *)

let not_there_yet r ~time =
  let joins (v : Dolphin_scenario.Scenario.vehicle) =
    if v.joins > time then Some (Printf.sprintf "%s joins at %s" v.id (Phrase.time v.joins)) else None
  in
  match is_simulated r.settings, List.filter_map joins r.fleet.scenario.vehicles with
  | false, _ | true, [] -> None
  | true, late ->
    Some (Printf.sprintf "the pick gave up at %s, and %s: 'timeout' lets a pick wait longer" (Phrase.time time)
            (Dolphin_display.Wording.vehicles late))

(* Notes in [unmet] the message about a pick that ends the program. *)
let watching_picks r unmet : Observer.t =
  let transition ~time ~cause:_ (t : Transition.t) =
    match t.label, t.next.control with
    | No_vehicles _, Ended _ -> unmet := not_there_yet r ~time
    | _, _ -> ()
  in
  { Observer.nobody with transition }

(* {1 The socket} *)

(* A run whose time passes by itself has one, beside its journal. *)
let open_socket r recording ~replacement ~interruption ~inputs ~now ~virtual_time =
  match Recording.journal recording with
  | Some journal when r.settings.socket && not virtual_time -> (
      let stop () = Interruption.once_more interruption in
      let program () = Replacement.program replacement and replace = Replacement.replace replacement in
      match Run_socket.open_ { program; inputs; now; stop; replace } ~journal with
      | Ok socket -> Some socket
      | Error why -> r.front.notice why; None)
  | Some _ | None -> None

let telling_followers socket : Observer.t =
  match socket with
  | None -> Observer.nobody
  | Some socket ->
    { Observer.nobody with
      transition = (fun ~time:_ ~cause:_ _ -> Run_socket.journal_grew socket);
      news = (fun ~time:_ _ -> Run_socket.journal_grew socket) }

(* {1 The run} *)

let beginning resumed news : Driver.beginning option =
  let of_past ({ past; _ } : Resumed.t) : Driver.beginning =
    let replay = past.replay in
    { configuration = Replay.configuration replay; world = Replay.world replay; news;
      (* That a program is stuck is found out again; a request to end is made again. *)
      pending = (match past.pending with Some Interruption -> None | pending -> pending);
      transitions = Replay.transitions replay;
      time = Replay.time replay }
  in
  Option.map of_past resumed

(* A run that was stuck when its console died ends as one that is stuck, whichever console sees its end. *)
let as_it_began r : Driver.outcome -> Driver.outcome = function
  | Ended Interrupted as ended ->
    let stuck (resumed : Resumed.t) = Replay.stuck resumed.past.replay in
    (match Option.bind r.resumed stuck with
     | None -> ended
     | Some (In residual) -> Stuck residual
     | Some (At site) -> Spins site)
  | (Ended (Completed | Halted _ | Failed _) | Stuck _ | Spins _) as outcome -> outcome

let drive r recording host ~interruption (Platform ((module P), { platform; estimates; news; leave = _ })) =
  let now () = P.now platform and scenario = r.fleet.scenario in
  let inputs = Inputs.create () in
  let replacement =
    Replacement.make { fleet = r.fleet; recording; now; took = r.front.replaced } r.program in
  let socket = open_socket r recording ~replacement ~interruption ~inputs ~now ~virtual_time:P.virtual_time in
  r.front.opened { now; estimates; post = Inputs.post inputs;
                   questions = (fun () -> Inputs.questions inputs);
                   replace = Replacement.replace replacement;
                   acted = (fun act -> Recording.act recording ~time:(now ()) act) };
  let console =
    Questions.console r.front.person ~answered:(History.answers (history r)) ~answers:r.settings.answers
      ~scenario:(if r.settings.people then { scenario with answers = [] } else scenario)
  in
  let unmet = ref None in
  let observer =
    let unasked () = Interruption.is_unasked interruption in
    List.fold_left Observer.both (Recording.observer recording ~unasked)
      [ telling_followers socket; r.front.observer; watching_picks r unmet ]
  in
  let run () =
    (* A request to end that the console which died had not carried out. *)
    if Option.fold r.resumed ~none:false ~some:(fun (resumed : Resumed.t) -> resumed.past.interrupted) then
      Interruption.interrupt interruption;
    Driver.run (module P) platform
      ~always_telemetry:
        ((not P.virtual_time) || r.front.wants_telemetry || r.resumed <> None
         || Recording.is_wanted r.settings.recording)
      ~observer
      ~host:(match host with Some host -> Host.call host | None -> Replies.call ~past:(history r) scenario)
      ~inputs ~replacements:(Replacement.inbox replacement) ?beginning:(beginning r.resumed news) ?fenced:r.fenced
      ~console ~interruption:(Interruption.promise interruption)
      ~again:(Interruption.again interruption) ~breakable:(Interruption.breakable interruption)
      ~giving_up:(Interruption.unasked interruption) r.program.program
  in
  let finish (outcome : Driver.outcome) =
    let outcome = as_it_began r outcome in
    let stuck = match outcome with Stuck _ | Spins _ -> true | Ended _ -> false in
    Option.iter r.front.notice !unmet;
    Result.map (fun () -> outcome) (Recording.finish recording ~time:(now ()) ~stuck)
  in
  let unavailable why = Lwt.return (Error (Error.Unavailable why)) in
  let close () = Replacement.close replacement; close_host host in
  let close_socket () = Option.fold socket ~none:Lwt.return_unit ~some:Run_socket.close in
  Lwt.catch
    (fun () -> Lwt.finalize (fun () -> Lwt.finalize run close >|= finish) close_socket)
    (function
      | Recording.Broken why -> unavailable (why ^ "; the run was ended as by Ctrl-C")
      | Unix.Unix_error (error, call, _) ->
        unavailable (Printf.sprintf "trouble of the platform: %s: %s" call (Unix.error_message error))
      | Udp_platform.Superseded why -> unavailable why
      | error -> Lwt.fail error)

let ( let*? ) result f = match result with Ok x -> f x | Error _ as error -> Lwt.return error

(* The journal begins when nothing stands against the run any more. *)
let run_on r recording ~interruption (Platform (_, fleet) as platform) =
  let give_up error = fleet.leave () >|= fun () -> error in
  match start_host r with
  | Error _ as error -> give_up error
  | Ok host -> (
      match Recording.begin_ recording with
      | Ok () -> drive r recording host ~interruption platform
      | Error _ as error -> close_host host >>= fun () -> give_up error)

(* The date at which it begins: on a network that of the clock, in simulated time that of the fleet. *)
let beginning_now settings (program : Program_file.t) (fleet : Fleet_file.t) =
  let at begins =
    Ok ({ program with program = { program.program with begins } }, Fleet_file.beginning begins fleet) in
  let is_read = program.program.reads_time_of_day in
  if not (is_simulated settings) then at (if is_read then Some (Local_time.now fleet.scenario.zone) else None)
  else if is_read && fleet.scenario.begins = None then
    Error
      (Error.Bad_input
         (program.path ^ ": it reads the time of day: give --begins '2026-06-01 21:00', or write in the fleet: \
                          begins '2026-06-01 21:00'"))
  else at fleet.scenario.begins

(* The message about a run that was interrupted while its platform was opened. *)
let unbegun r =
  match r.resumed with
  | None -> "interrupted before the run began: nothing was started"
  | Some { path; _ } ->
    Printf.sprintf "interrupted before the run went on: no vehicle was ordered to stop; go on with it by --resume %s"
      path

let go r ~interruption recording =
  Sys.set_signal Sys.sigpipe Signal_ignore;
  let*? recording = recording in
  let run () =
    Interruption.unless interruption (fun () -> open_platform r recording) >>= function
    | None -> Lwt.return (Error (Error.Interrupted (unbegun r)))
    | Some platform ->
      let*? platform = platform in
      run_on r recording ~interruption platform
  in
  Lwt.finalize run (fun () -> Recording.close recording; Lwt.return_unit)

let new_identity () =
  let random = Random.State.make_self_init () in
  String.concat "" (List.init 4 (fun _ -> Printf.sprintf "%07x" (Random.State.bits random lsr 2)))

let start front ~interruption (settings : settings) program (fleet : Fleet_file.t) =
  let*? program, fleet = beginning_now settings program fleet in
  let seed = Option.value settings.seed ~default:0 in
  let run = if is_simulated settings then None else Some (new_identity ()) in
  let r = { front; settings; seed; run; program; fleet; resumed = None; fenced = None } in
  log_start settings program fleet ~seed;
  go r ~interruption (Recording.start settings.recording (header r fleet) program.program)

(* {1 Resumption} *)

let ( let* ) = Result.bind

(* The fences of plans are part of the record. *)
let fleet_of_network ~named (resumed : Resumed.t) =
  match resumed.past.header.fleet, named with
  | Some _, _ -> Resumed.fleet resumed ~named
  | None, None -> Ok Fleet_file.nobody
  | None, Some path ->
    let* fleet = Fleet_file.load named in
    let refuse what =
      let why = Printf.sprintf "%s: a run goes on with the %s that it began with, and it had no fleet" path what in
      Error (Error.Bad_input why)
    in
    if fleet.scenario.fences <> [] then refuse "fences"
    else if fleet.scenario.plans_at <> None then refuse "place for its plans"
    else Ok fleet

(* The fleet and the settings with which a run is resumed: seed and speed are those of its journal. *)
let as_before (settings : settings) ~fleet (resumed : Resumed.t) =
  let header = resumed.past.header in
  let refuse why = Error (Error.Bad_input (resumed.path ^ ": " ^ why)) in
  match header.platform, is_simulated settings with
  | "sim", false -> refuse "this run was on a simulated fleet: leave out --imc and --platform"
  | "sim", true when settings.seed <> None -> refuse "a run goes on with the seed that it began with: leave out --seed"
  | "sim", true ->
    let speed = if settings.speed = None then header.speed else settings.speed in
    Result.map (fun fleet -> (fleet, { settings with speed })) (Resumed.fleet resumed ~named:fleet)
  | platform, false when platform = Networks.name (choice settings) ->
    Result.map (fun fleet -> (fleet, { settings with speed = None })) (fleet_of_network ~named:fleet resumed)
  | platform, (true | false) ->
    refuse
      (Printf.sprintf "this run was on vehicles of a network, which will move again: give %s"
         (String.concat " and " (Networks.options_of platform)))

let resumption front settings ~changed ~fleet program path =
  let* resumed = Resumed.read ~changed ~tell:front.replayed program path in
  let* fleet, settings = as_before settings ~fleet resumed in
  let fleet = Fleet_file.beginning resumed.past.header.begins fleet in
  let* program = Program_file.within fleet program in
  if settings.supplier = None && not (Replies.are_of fleet.scenario resumed.past.history) then
    Error
      (Error.Bad_input
         (path ^ ": this run has a supplier, which died with its console: name it again with --supplier"))
  else
    let seed = resumed.past.header.seed in
    let fences = program.program.fences in
    let fenced =
      if Fences.is_none fences then None else Some (Fence_guard.replay fences resumed.past.history) in
    log_start settings program fleet ~seed;
    let run = resumed.past.header.run in
    Ok ({ front; settings; seed; run; program; fleet; resumed = Some resumed; fenced }, resumed)

let resume front ~interruption (settings : settings) ~changed ~fleet program path =
  let*? r, resumed = resumption front settings ~changed ~fleet program path in
  let source = Program_file.header program in
  go r ~interruption (Recording.resume settings.recording program.program ~source resumed)
