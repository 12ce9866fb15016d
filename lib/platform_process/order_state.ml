open Dolphin_semantics
open Dolphin_platform_protocol

type stage = Unwritten | Unsent | Ordered | Taken

type t = {
  request : string;
  plan : string;
  body : Yojson.Safe.t;
  stage : stage;
  wanted : bool;
  is_resumed : bool;
  is_on_disk : bool;
  doubt : Order.doubt option;
  begun : float;
  asked : float;
  stop_sent : float option;
  notes : Yojson.Safe.t list;
  share : float option;
  remaining : float option;
}

let make ~now ~request (task : Core.platform_task) =
  { request; plan = task.name; body = Plan_body.to_json task; stage = Unwritten; wanted = true; is_resumed = false;
    is_on_disk = false; doubt = None; begun = now; asked = now; stop_sent = None; notes = []; share = None;
    remaining = None }

let outstanding ?(is_on_disk = true) ?doubt ~now ~request ~plan ~body ~wanted ~notes () =
  { request; plan; body; stage = Ordered; wanted; is_resumed = false; is_on_disk; doubt; begun = now; asked = now;
    stop_sent = None; notes; share = None; remaining = None }

let is_sent e = match e.stage with Unwritten | Unsent -> false | Ordered | Taken -> true
let stop_patience = 60.

let due ~link ~lost ~timeout ~patience e =
  let stop = match e.stop_sent with Some sent when not e.wanted -> sent +. stop_patience | Some _ | None -> infinity in
  let end_ =
    match link, e.stage with
    | _ when not e.wanted -> infinity
    | None, _ -> Float.max lost e.begun +. timeout
    | Some since, Ordered -> Float.max since e.asked +. patience
    | Some _, (Unwritten | Unsent | Taken) -> infinity
  in
  Float.min stop end_
