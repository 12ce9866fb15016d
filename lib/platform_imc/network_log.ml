open Dolphin_imc
open Dolphin_runtime

let source = Logs.Src.create "dolphin.imc" ~doc:"Datagrams to and from vehicles, their state, timers"

module Log = (val Logs.src_log source : Logs.LOG)

let is_on () = Logs.Src.level source = Some Logs.Debug

(* {1 Datagrams} *)

let message_name id =
  match Definition.find (Lazy.force Definition.builtin) id with
  | Some message -> message.name
  | None -> Printf.sprintf "message %d" id

let pp_packet ppf (bytes, len) =
  match Header.read ~len bytes with
  | Ok h -> Fmt.pf ppf "%s from 0x%04x to 0x%04x, %d bytes" (message_name h.id) h.src h.dst len
  | Error why -> Fmt.pf ppf "%d bytes that are not a packet: %s" len (Error.label why)

let pp_host ppf host = Fmt.string ppf (Unix.string_of_inet_addr host)

let received ~now ~from ~len buffer =
  Log.debug (fun m ->
      m "%.3f in from %a: %a" now pp_host from pp_packet (Bytes.sub_string buffer 0 len, len))

let sent ~now host port bytes =
  Log.debug (fun m -> m "%.3f out to %a:%d: %a" now pp_host host port pp_packet (bytes, String.length bytes))

let unsent ~now host port error =
  Log.debug (fun m -> m "%.3f unsent to %a:%d: %s" now pp_host host port (Unix.error_message error))

(* {1 Vehicles} *)

let stage : Execution.stage -> string = function
  | Starting -> "starting"
  | Running -> "running"
  | Stopping -> "stopping"

let describe (s : Station.system) =
  let execution = s.node.execution in
  let ours =
    match Execution.progress execution with
    | Some p -> Printf.sprintf ", %s plan %s" (stage p.stage) p.plan
    | None -> ""
  in
  let says = match Execution.executing execution with Some plan -> ", executes " ^ plan | None -> "" in
  Printf.sprintf "%s, mode %s, %s%s%s"
    (if s.linked then "link" else "no link")
    (Node.mode ~names:[] s.node)
    (if s.state.connected then Option.value s.state.unready ~default:"is ready" else "is not connected")
    ours says

let changed ~now before after =
  if is_on () then begin
    let named (s : Station.system) = (s.node.name, describe s) in
    let described station = List.map named (Station.systems ~now station) in
    let known = described before in
    let tell (name, text) =
      if List.assoc_opt name known <> Some text then Log.debug (fun m -> m "%.3f %s: %s" now name text)
    in
    List.iter tell (described after)
  end

(* {1 Timers and events} *)

let timer_set ~now timer seconds = Log.debug (fun m -> m "%.3f timer %d set: %g s" now timer seconds)
let timer_cancelled ~now timer = Log.debug (fun m -> m "%.3f timer %d cancelled" now timer)

let event ~now (e : Platform.event) =
  match e with
  | Timer timer -> Log.debug (fun m -> m "%.3f timer %d fired" now timer)
  | Task_done v -> Log.debug (fun m -> m "%.3f %s is done" now v)
  | Task_failed (v, why) -> Log.debug (fun m -> m "%.3f %s failed: %s" now v why)
  | Vehicle _ | Input _ | Quiet -> ()
