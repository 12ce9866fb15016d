open Dolphin_runtime
open Dolphin_display
open Dolphin_trace

type t = {
  path : string;
  past : Resumption.t;
  log : Log.t;
  board : Status.t;
  builder : Summary.builder;
}

(* The log and the board as they were when the console died; nothing is printed again. *)
let remember log board (entry : Entry.t) replay =
  match entry, Replay.latest replay with
  | Vehicle { time; state }, _ ->
    log := fst (Log.news !log ~time state);
    board := Status.news !board ~time state
  | Transition { time; _ }, Some (_, t) ->
    log := fst (Log.transition !log ~time t);
    board := Status.transition !board ~time t
  | (Header _ | Partial _ | Label _ | Event _ | Transition _ | Note _ | Resumed _ | End _), _ -> ()

let read_channel ~changed (program : Program_file.t) path channel =
  let log = ref Log.start and board = ref Status.start and builder = Summary.create () in
  let tell entry replay =
    Summary.add builder entry;
    remember log board entry replay
  in
  let { Header.hash; path = _ } = Header.source ~path:program.path program.source in
  match Resumption.read ~tell ~changed program.program ~hash (Journal.of_channel channel) with
  | Ok past -> Ok { path; past; log = !log; board = !board; builder }
  | Error trouble -> Error (Format.asprintf "@[<v 2>%s: %a@]" path Resumption.pp_trouble trouble)

let read ~changed program path =
  let read () =
    let channel = open_in_bin path in
    Fun.protect ~finally:(fun () -> close_in_noerr channel) (fun () -> read_channel ~changed program path channel)
  in
  match read () with
  | result -> result
  | exception Sys_error why -> Error (if String.length why > 0 && why.[0] = path.[0] then why else path ^ ": " ^ why)

let fleet r ~named =
  let header = r.past.header in
  let same (fleet : Fleet_file.t) =
    let path = Option.value fleet.path ~default:"the built-in fleet" in
    let found = Option.map (fun _ -> (Header.source ~path fleet.source).hash) fleet.path in
    if found = Option.map (fun (s : Header.source) -> s.hash) header.fleet then Ok fleet
    else Error (Fleet_file.Unreadable (path ^ ": this is not the fleet that the run was on, or it has changed since"))
  in
  let path = match named with Some _ -> named | None -> Option.map (fun (s : Header.source) -> s.path) header.fleet in
  Result.bind (Fleet_file.load path) same
