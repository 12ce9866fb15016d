open Dolphin_semantics
open Dolphin_runtime
open Lwt.Infix

type fate = Succeeds of float | Fails of float * string | Goes_on

module Queue = Map.Make (struct
    type t = float * int

    let compare (time, i) (time', i') = match Float.compare time time' with 0 -> Int.compare i i' | order -> order
  end)

type t = {
  fate : Core.vehicle -> string -> fate;
  mutable due : Platform.event Queue.t;  (* by time, then by when it was scheduled *)
  mutable scheduled : int;
  timers : (Residual.timer, float * int) Hashtbl.t;
  tasks : (Core.vehicle, float * int) Hashtbl.t;
  mutable now : float;
  added : unit Lwt_condition.t;
  mutable fails_on_start : bool;
  mutable log : string list;
}

let schedule m seconds event =
  m.scheduled <- m.scheduled + 1;
  let key = (m.now +. seconds, m.scheduled) in
  m.due <- Queue.add key event m.due;
  Lwt_condition.signal m.added ();
  key

let make ?(fate = fun _ _ -> Succeeds 10.) events =
  let m =
    { fate; due = Queue.empty; scheduled = 0; timers = Hashtbl.create 10; tasks = Hashtbl.create 10; now = 0.;
      added = Lwt_condition.create (); fails_on_start = false; log = [] }
  in
  List.iter (fun (time, event) -> ignore (schedule m time event)) events;
  m

let vehicle ?(kind = "UUV") ?(battery = 1.) ?(connected = true) id : World.vehicle_state =
  { id; kind; payload = []; position = { latitude = 41.; longitude = -8.; height = 0. }; battery = Some battery;
    depth = None; altitude = None; speed = Some 0.; readings = []; connected; unready = None; cruise = None;
    drain = None; progress = [] }

let silent time id = (time, Platform.Vehicle { (vehicle id) with battery = None })
let seen ?battery time id = (time, Platform.Vehicle (vehicle ?battery id))
let fail_on_start m = m.fails_on_start <- true
let log m = List.rev m.log

module Make (Time : sig
    val virtual_time : bool
  end) =
struct
  type nonrec t = t

  let name = "mock"
  let virtual_time = Time.virtual_time
  let order = World.By_hearing
  let now m = m.now
  let announce_period _ = 10.
  let note m format = Printf.ksprintf (fun text -> m.log <- Printf.sprintf "%g %s" m.now text :: m.log) format

  let rec next m =
    match Queue.min_binding_opt m.due with
    | None -> Lwt_condition.wait m.added >>= fun () -> next m
    | Some (((time, _) as key), event) ->
      m.due <- Queue.remove key m.due;
      m.now <- Float.max m.now time;
      if virtual_time then Lwt.return event else Lwt.pause () >|= fun () -> event

  let drop m table x =
    Option.iter (fun key -> m.due <- Queue.remove key m.due) (Hashtbl.find_opt table x);
    Hashtbl.remove table x

  let set_timer m timer seconds = Hashtbl.replace m.timers timer (schedule m seconds (Platform.Timer timer))
  let cancel_timer m timer = drop m m.timers timer
  let bind m vs = note m "bind %s" (String.concat " " vs)
  let release m vs = note m "release %s" (String.concat " " vs)

  let start m ~number:_ v (task : Core.platform_task) =
    if m.fails_on_start then failwith "no link";
    note m "start %s %s" v task.name;
    let later seconds event = Hashtbl.replace m.tasks v (schedule m seconds event) in
    match m.fate v task.name with
    | Succeeds seconds -> later seconds (Platform.Task_done v)
    | Fails (seconds, why) -> later seconds (Platform.Task_failed (v, why))
    | Goes_on -> ()

  let stop m v =
    note m "stop %s" v;
    drop m m.tasks v

  let set_connection_timeout m vs seconds =
    note m "timeout %s %g" (match vs with None -> "all" | Some vs -> String.concat " " vs) seconds

  let telemetry m how = note m "telemetry %b" (how <> Platform.Off)
  let look _ = []

  let close m =
    note m "close";
    Lwt.return_unit
end

module Virtual = Make (struct
    let virtual_time = true
  end)

module Paced = Make (struct
    let virtual_time = false
  end)
