open Dolphin_app
open Dolphin_json
open Dolphin_runtime
open Lwt.Infix

module Names = Map.Make (String)

type listening = { stop : unit Lwt.u; over : unit Lwt.t }

type t = {
  choice : Networks.choice;
  changed : unit -> unit;
  mutable vehicles : Dolphin_trace.Entry.t Names.t;
  mutable time : float;
  mutable error : string option;
  mutable latest : Yojson.Safe.t;
  mutable due : bool;
  mutable listening : listening option;
}

let patience = 5.
let to_json h = h.latest

let json h : Yojson.Safe.t =
  let line (_, entry) = Result.value (Host_value.parse (Dolphin_trace.Entry.to_string entry)) ~default:`Null in
  `Assoc
    [ ("time", Canonical.number h.time); ("vehicles", `List (List.map line (Names.bindings h.vehicles)));
      ("error", Field.of_option (fun why -> `String why) h.error) ]

(* News of a second are sent together: many vehicles report at different moments. *)
let news h =
  if not h.due then begin
    h.due <- true;
    let send () =
      h.due <- false;
      h.latest <- json h;
      h.changed ()
    in
    Lwt.async (fun () -> Lwt_unix.sleep 1. >|= send)
  end

let fail h why =
  h.error <- Some why;
  news h

let surroundings : Networks.surroundings =
  { program = "console"; run = ""; note = (fun _ _ -> ()); keep = (fun ~time:_ _ _ -> ()); sync = None; past = None }

let follow h (Several.Part ((module P), p)) =
  P.telemetry p Shown;
  h.error <- None;
  let rec go_on () =
    P.next p >>= fun event ->
    h.time <- P.now p;
    (match event with
     | Vehicle state ->
       h.vehicles <- Names.add state.id (Dolphin_trace.Entry.Vehicle { time = h.time; state }) h.vehicles;
       news h
     | Task_done _ | Task_failed _ | Timer _ | Input _ | Quiet -> ());
    go_on ()
  in
  go_on ()

let in_words = function Failure why -> why | e -> Printexc.to_string e

(* A platform that cannot be opened, or has ended, is opened again after a while. *)
let rec attend h ~stopped =
  let again () =
    Lwt.pick [ Lwt_unix.sleep patience; Lwt.protected stopped ] >>= fun () ->
    if Lwt.is_sleeping stopped then attend h ~stopped else Lwt.return_unit
  in
  let opened = Lwt.catch (fun () -> Networks.open_ h.choice surroundings)
      (function Lwt.Canceled -> Lwt.fail Lwt.Canceled | e -> Lwt.return (Error (in_words e))) in
  Lwt.pick [ (opened >|= Option.some); (Lwt.protected stopped >|= fun () -> None) ] >>= function
  | None -> Lwt.return_unit
  | Some (Error why) -> fail h why; again ()
  | Some (Ok { part; leave; _ }) ->
    let failed = function Lwt.Canceled -> () | e -> fail h (in_words e) in
    let heard () = Lwt.pick [ follow h part; Lwt.protected stopped ] in
    Lwt.catch heard (fun e -> failed e; Lwt.return_unit) >>= fun () ->
    Lwt.pick [ leave (); Lwt_unix.sleep patience ] >>= fun () ->
    if Lwt.is_sleeping stopped then again () else Lwt.return_unit

let listen h =
  if h.listening = None then begin
    h.vehicles <- Names.empty;
    h.error <- None;
    h.latest <- json h;
    let stopped, stop = Lwt.wait () in
    h.listening <- Some { stop; over = attend h ~stopped }
  end

let leave h =
  match h.listening with
  | None -> Lwt.return_unit
  | Some { stop; over } ->
    h.listening <- None;
    Lwt.wakeup_later stop ();
    Lwt.pick [ over; Lwt_unix.sleep patience ]

let make choice ~changed =
  let h =
    { choice; changed; vehicles = Names.empty; time = 0.; error = None; latest = `Null; due = false;
      listening = None }
  in
  listen h;
  h
