open Dolphin_semantics
open Dolphin_runtime
open Dolphin_trace
module Scenario = Dolphin_scenario.Scenario
module Simulator = Dolphin_platform_sim.Simulator

type t = { name : string; program : Core.program; hash : string; journal : string }

let folder = "../../examples"

let read path =
  let channel = open_in_bin path in
  Fun.protect
    ~finally:(fun () -> close_in channel)
    (fun () -> really_input_string channel (in_channel_length channel))

let examples =
  let program file = Filename.chop_suffix_opt ~suffix:".dol" file in
  List.sort String.compare (List.filter_map program (Array.to_list (Sys.readdir folder)))

let explain source ds =
  failwith (String.concat "\n" (List.map (Format.asprintf "%a" (Dolphin_syntax.Diagnostic.pp ~source)) ds))

let compile name source =
  let elaborate = Elaborate.program ~source_name:name in
  match Result.bind (Dolphin_syntax.Parse.program ~file:name source) elaborate with
  | Ok (program, _) -> program
  | Error ds -> explain source ds

let console scenario =
  let asked = Hashtbl.create 4 in
  let ask prompt =
    let n = Option.value (Hashtbl.find_opt asked prompt) ~default:0 in
    Hashtbl.replace asked prompt (n + 1);
    Lwt.return (Option.to_result ~none:"nobody is there" (Scenario.answer scenario prompt n))
  in
  { Console.say = ignore; ask; refused = ignore }

let host path =
  if Sys.file_exists path then
    match Host.start ("python3 " ^ path) with Ok host -> Some host | Error why -> failwith why
  else None

let go ~seed ?period ~name ~source ~scenario host =
  let program = compile name source in
  let journal = Buffer.create 65536 in
  let write entry = Buffer.add_string journal (Entry.to_string entry ^ "\n") in
  let its_source = Header.source ~path:name source in
  let header : Header.t =
    { program = its_source; fleet = None; platform = "sim"; seed; speed = None; started = "2026-03-01T12:00:00Z" }
  in
  let recorder = Recorder.make ?period program header write in
  let observer : Observer.t =
    { transition = Recorder.transition recorder; news = Recorder.news recorder }
  in
  let platform = Simulator.Virtual.create ~seed scenario in
  let run =
    Driver.run (module Simulator.Virtual) platform ~always_telemetry:true ~observer ?host:(Option.map Host.call host)
      ~console:(console scenario) ~interruption:(fst (Lwt.wait ())) program
  in
  let outcome = Lwt_main.run run in
  Option.iter (fun host -> Lwt_main.run (Host.close host)) host;
  let stuck = match outcome with Stuck _ -> true | Ended _ -> false in
  Recorder.finish recorder ~time:(Simulator.Virtual.now platform) ~stuck;
  { name; program; hash = its_source.hash; journal = Buffer.contents journal }

let run ?(seed = 0) ?period name =
  let file ending = Filename.concat folder (name ^ ending) in
  let fleet = read (file ".fleet") in
  match Scenario.read ~file:(file ".fleet") fleet with
  | Error ds -> explain fleet ds
  | Ok scenario -> go ~seed ?period ~name ~source:(read (file ".dol")) ~scenario (host (file ".py"))

let of_scenario ?period scenario source = go ~seed:0 ?period ~name:"test.dol" ~source ~scenario None
let of_text ?period source = of_scenario ?period Scenario.default source
let check_text r journal = snd (Verdict.check r.program ~hash:r.hash (Reader.of_string journal))
let check r = check_text r r.journal
let lines journal = List.filter (fun line -> line <> "") (String.split_on_char '\n' journal)
let text lines = String.concat "" (List.map (fun line -> line ^ "\n") lines)
