open Dolphin_semantics
open Dolphin_runtime
open Dolphin_trace
module Udp_platform = Dolphin_platform_imc.Udp_platform

type death = Before of int | Within of int | After of int | Never

let program, hash =
  let parsed = Dolphin_syntax.Parse.program ~file:"mission.dol" Mission.source in
  match Result.bind parsed (Elaborate.program ~source_name:"mission.dol") with
  | Ok (program, _) -> (program, (Header.source ~path:"mission.dol" Mission.source).hash)
  | Error ds ->
    List.iter (Format.eprintf "%a@." (Dolphin_syntax.Diagnostic.pp ~source:Mission.source)) ds;
    failwith "the program of the kill tests is wrong"

let source = { Header.path = "mission.dol"; hash; set = [] }
let started = "2026-03-01T12:00:00Z"

let header : Header.t =
  { program = source; fleet = None; platform = "imc"; order = Udp_platform.order; seed = 0; speed = None; started;
    run = None;
    fences = []; place = None; begins = None }

let die () =
  Unix.kill (Unix.getpid ()) Sys.sigkill;
  assert false

(* Writes straight to the file, so that the death of a process loses nothing. *)
let write_all fd text = ignore (Unix.write_substring fd text 0 (String.length text))

let writer ?(notes = 0) fd death ~from =
  let count = ref from and numbering = Journal.numbering ~notes in
  fun (entry : Entry.t) ->
    let line = Journal.line numbering entry ^ "\n" in
    match entry with
    | Vehicle _ -> write_all fd line
    | Header _ | Partial _ | Label _ | Event _ | Transition _ | Note _ | Act _ | Resumed _ | End _ ->
      let i = !count in
      incr count;
      if death = Before i then die ();
      if death = Within i then begin
        write_all fd (String.sub line 0 (String.length line / 2));
        die ()
      end;
      write_all fd line;
      if death = After i then die ()

let console = { Console.say = ignore; ask = (fun _ -> Lwt.return (Ok "2")); refused = ignore }

let options ~port ~keep =
  { Udp_platform.default with
    loopback = true; announce_ports = List.init 5 (fun i -> port + i); close_patience = 2.; keep;
    sync = Some (fun () -> Lwt_unix.sleep 0.005) }

let drive recorder platform beginning =
  let observer : Observer.t = { transition = Recorder.transition recorder; news = Recorder.news recorder;
                                unknown = Observer.nobody.unknown } in
  let run =
    Driver.run (module Udp_platform) platform ~always_telemetry:true ~observer ?beginning ~console
      ~interruption:(fst (Lwt.wait ())) program
  in
  let outcome = Lwt_main.run run in
  Recorder.finish recorder ~time:(Udp_platform.now platform) ~stuck:false;
  match outcome with
  | Ended Completed -> 0
  | Ended _ | Stuck _ | Spins _ -> Format.eprintf "%a@." Driver.pp_outcome outcome; 1

let keep_with recorder ~time vehicle note =
  Recorder.write (Option.get !recorder) ~time (fun ~time -> Note { time; vehicle; note })

let opened = function Ok platform -> platform | Error why -> failwith why

let begin_run ~port fd death =
  let recorder = ref None in
  let platform = opened (Udp_platform.open_ (options ~port ~keep:(keep_with recorder))) in
  let its_recorder = Recorder.make program header (writer fd death ~from:0) in
  recorder := Some its_recorder;
  drive its_recorder platform None

let go_on ~port ~journal fd death =
  let channel = open_in_bin journal in
  let counted = ref 0 in
  let tell (entry : Entry.t) _ = match entry with Vehicle _ -> () | _ -> incr counted in
  match Resumption.read ~tell program ~hash (Journal.of_channel channel) with
  | Error (No_run (Unreadable { number = 1; _ })) ->
    (* Not even the header is whole: nothing was done. *)
    Unix.ftruncate fd 0;
    begin_run ~port fd death
  | Error (Over { how = "completed"; _ }) -> 0
  | Error trouble -> failwith (Format.asprintf "@[<v>%a@]" Resumption.pp_trouble trouble)
  | Ok past ->
    Unix.ftruncate fd past.kept;
    let recorder = ref None in
    let time = Replay.time past.replay in
    (* Before the platform is opened, which listens for some seconds and may keep notes meanwhile. *)
    let its_recorder =
      Recorder.resume program past.replay ~seen:(Resumption.seen past)
        (writer ~notes:past.notes fd death ~from:!counted)
    in
    recorder := Some its_recorder;
    Recorder.write its_recorder ~time (fun ~time -> Resumed { time; program = source; at = started });
    let again = Udp_platform.open_again (options ~port ~keep:(keep_with recorder)) ~time past.history in
    let platform = opened (Lwt_main.run again) in
    let world = Replay.world past.replay in
    let news = List.map (fun s -> { s with World.connected = false }) (World.vehicles world) in
    drive its_recorder platform
      (Some { configuration = Replay.configuration past.replay; world; news; pending = past.pending;
              transitions = Replay.transitions past.replay;
              time = Replay.time past.replay })

(* The library's debug log of datagrams, vehicles and timers. *)
let log_to path =
  let fd = Unix.openfile path [ O_WRONLY; O_CREAT; O_APPEND ] 0o644 in
  let report _ _ ~over k message =
    let write text = write_all fd (text ^ "\n"); over (); k () in
    message (fun ?header:_ ?tags:_ format -> Format.kasprintf write format)
  in
  Logs.set_reporter { Logs.report };
  Logs.set_level ~all:true (Some Debug);
  Logs.debug (fun m -> m "a console begins")

let start ~port ~journal ~log death =
  Processes.fork (fun () ->
      log_to log;
      let is_there = Sys.file_exists journal in
      let fd = Unix.openfile journal [ O_RDWR; O_CREAT; O_APPEND ] 0o644 in
      if is_there then go_on ~port ~journal fd death else begin_run ~port fd death)
