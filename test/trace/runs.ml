open Dolphin_plans
open Dolphin_semantics
open Dolphin_runtime
open Dolphin_trace
module Scenario = Dolphin_scenario.Scenario
module Simulator = Dolphin_platform_sim.Simulator

type t = {
  name : string;
  program : Core.program;
  hash : string;
  journal : string;
  scenario : Scenario.t;
  seed : int;
  period : float option;
  host : unit -> Host.t option;
}

let folder = Test_support.Examples.folder

let read path =
  let channel = open_in_bin path in
  Fun.protect
    ~finally:(fun () -> close_in channel)
    (fun () -> really_input_string channel (in_channel_length channel))

let examples = Test_support.Examples.names ()

let explain source ds =
  failwith (String.concat "\n" (List.map (Format.asprintf "%a" (Dolphin_syntax.Diagnostic.pp ~source)) ds))

let compile ?place name source =
  let elaborate = Elaborate.program_at ~place ~source_name:name in
  match Result.bind (Test_support.Pure_run.read ~file:name source) elaborate with
  | Ok (program, _) -> program
  | Error ds -> explain source ds

(* An answer that was refused is not given again. *)
let console ?(answered = []) scenario =
  let asked = Hashtbl.create 4 and refused = Hashtbl.create 4 and latest = ref ("", "") in
  let next prompt = Option.value (Hashtbl.find_opt asked prompt) ~default:0 in
  let count prompt = Hashtbl.replace asked prompt (next prompt + 1) in
  List.iter (fun (prompt, _) -> count prompt) answered;
  let ask prompt =
    let n = next prompt in
    count prompt;
    Lwt.return
      (match Scenario.answer scenario prompt n with
       | Some text when not (Hashtbl.mem refused (prompt, text)) -> latest := (prompt, text); Ok text
       | Some _ | None -> Error "nobody is there")
  in
  { Console.say = ignore; ask; refused = (fun _ -> Hashtbl.replace refused !latest ()) }

let host path =
  if Sys.file_exists path then
    match Host.start ("python3 " ^ path) with Ok host -> Some host | Error why -> failwith why
  else None

let started = "2026-03-01T12:00:00Z"

(* Writes the following lines to [journal], by [recorder]. *)
let drive r recorder platform ?beginning ?fenced ~answered host =
  let observer : Observer.t = { transition = Recorder.transition recorder; news = Recorder.news recorder;
                                unknown = Observer.nobody.unknown } in
  let host = host () in
  let run =
    Driver.run (module Simulator.Virtual) platform ~always_telemetry:true ~observer ?host:(Option.map Host.call host)
      ?beginning ?fenced ~console:(console ~answered r.scenario) ~interruption:(fst (Lwt.wait ())) r.program
  in
  let outcome = Lwt_main.run run in
  Option.iter (fun host -> Lwt_main.run (Host.close host)) host;
  let stuck = match outcome with Stuck _ | Spins _ -> true | Ended _ -> false in
  Recorder.finish recorder ~time:(Simulator.Virtual.now platform) ~stuck

let write_to journal entry = Buffer.add_string journal (Entry.to_string entry ^ "\n")

let go ~seed ?period ~name ~source ~scenario host =
  let program = { (compile ?place:scenario.Scenario.plans_at name source) with begins = scenario.begins } in
  let journal = Buffer.create 65536 in
  let its_source = Header.source ~path:name source in
  let header : Header.t =
    { program = its_source; fleet = None; platform = "sim"; order = By_hearing; seed; speed = None; started;
      run = None;
      fences = Fences.list program.fences; place = program.place;
      begins = program.begins }
  in
  let recorder = Recorder.make ?period program header (write_to journal) in
  let r = { name; program; hash = its_source.hash; journal = ""; scenario; seed; period; host } in
  drive r recorder (Simulator.Virtual.create ~seed scenario) ~answered:[] host;
  { r with journal = Buffer.contents journal }

let resume r text =
  let refuse trouble = Error (Format.asprintf "@[<v>%a@]" Resumption.pp_trouble trouble) in
  match Resumption.read r.program ~hash:r.hash (Journal.of_string text) with
  | Error trouble -> refuse trouble
  | Ok past -> (
      let fenced = Fence_guard.replay r.program.fences past.history in
      match Simulator.Virtual.create_again ~seed:r.seed r.scenario fenced.history with
      | Error why -> Error why
      | Ok (platform, news) ->
        let journal = Buffer.create 65536 in
        Buffer.add_string journal (String.sub text 0 past.kept);
        let time = Replay.time past.replay in
        let program = { past.header.program with hash = r.hash } in
        let recorder =
          Recorder.resume ?period:r.period r.program past.replay ~seen:(Resumption.seen past) (write_to journal)
        in
        Recorder.write recorder ~time (fun ~time -> Resumed { time; program; at = started });
        let beginning : Driver.beginning =
          { configuration = Replay.configuration past.replay; world = Replay.world past.replay; news;
            pending = past.pending; transitions = Replay.transitions past.replay; time }
        in
        drive r recorder platform ~beginning ~fenced ~answered:(History.answers past.history) r.host;
        Ok (Buffer.contents journal))

let run ?(seed = 0) ?period name =
  let file ending = Filename.concat folder (name ^ ending) in
  let fleet = read (file ".fleet") in
  match Scenario.read ~file:(file ".fleet") fleet with
  | Error ds -> explain fleet ds
  | Ok scenario -> go ~seed ?period ~name ~source:(read (file ".dol")) ~scenario (fun () -> host (file ".py"))

let of_scenario ?period ?(seed = 0) scenario source =
  go ~seed ?period ~name:"test.dol" ~source ~scenario (fun () -> None)

let of_text ?period source = of_scenario ?period Scenario.default source
let check_text r journal = snd (Journal_verdict.check r.program ~hash:r.hash (Journal.of_string journal))
let check r = check_text r r.journal
let lines journal = List.filter (fun line -> line <> "") (String.split_on_char '\n' journal)
let text lines = String.concat "" (List.map (fun line -> line ^ "\n") lines)
