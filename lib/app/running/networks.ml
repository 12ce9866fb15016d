open Dolphin_semantics
open Dolphin_runtime
open Lwt.Infix
module Udp_platform = Dolphin_platform_imc.Udp_platform
module Process_platform = Dolphin_platform_process.Process_platform

type choice = { imc : Udp_platform.options option; adapters : string list }

let is_any c = c.imc <> None || c.adapters <> []
let process = Process_platform.name

let name c =
  match c.imc, c.adapters with
  | Some _, [] -> Udp_platform.name
  | None, _ -> process
  | Some _, _ :: _ -> Udp_platform.name ^ "+" ^ process

let options_of name =
  let option part = if part = process then "--platform" else "--" ^ part in
  List.map option (String.split_on_char '+' name)

type estimate = { vehicle : string; plan : string; share : float; remaining : float option }
type opened = { part : Several.part; estimates : unit -> estimate list; leave : unit -> unit Lwt.t }

type surroundings = {
  program : string;
  run : string;
  note : Core.vehicle option -> string -> unit;
  keep : time:float -> Core.vehicle -> Yojson.Safe.t -> unit;
  sync : (unit -> unit Lwt.t) option;
  past : (float * History.t) option;
}

let source = Logs.Src.create "dolphin.networks" ~doc:"Platforms that runs are opened on"

module Log = (val Logs.src_log source : Logs.LOG)

(* {1 IMC} *)

let imc_estimates network () =
  let of_system (system : Dolphin_platform_imc.Station.system) =
    match Udp_platform.progress network system.state.id with
    | Some { plan; share = Some share; remaining; _ } -> Some { vehicle = system.state.id; plan; share; remaining }
    | Some { share = None; _ } | None -> None
  in
  List.filter_map of_system (Udp_platform.systems network)

let log_network network =
  Log.info (fun m ->
      m "on the network as %s, IMC address 0x%04X, data port %d" (Udp_platform.name_on_network network)
        (Udp_platform.id network) (Udp_platform.data_port network))

(* [history name] is the part of the past that concerns the platform of this name. *)
let open_imc s ~history options =
  let note v = s.note (Some v) in
  let options = { options with Udp_platform.program = s.program; run = s.run; note; keep = s.keep; sync = s.sync } in
  let opened =
    match s.past with
    | None -> Lwt.return (Udp_platform.open_ options)
    | Some (time, _) -> Udp_platform.open_again options ~time (history Udp_platform.name)
  in
  let made network =
    log_network network;
    let part = Several.Part ((module Udp_platform), network) in
    (Udp_platform.name, { part; estimates = imc_estimates network; leave = (fun () -> Udp_platform.leave network) })
  in
  Lwt.map (Result.map made) opened

(* {1 Adapters} *)

let adapter_estimates adapter () =
  let of_vehicle (v : Dolphin_platform_process.Dispatch.vehicle) =
    match v.plan, v.share with
    | Some plan, Some share -> Some { vehicle = v.state.id; plan; share; remaining = v.remaining }
    | Some _, None | None, _ -> None
  in
  List.filter_map of_vehicle (Process_platform.vehicles adapter)

let open_adapter s ~history ~taken command =
  let options =
    { (Process_platform.default ~command) with
      program = Some s.program; run = s.run; taken; note = s.note; keep = s.keep; sync = s.sync }
  in
  let opened =
    match s.past with
    | None -> Process_platform.open_ options
    | Some (time, _) -> Process_platform.open_again options ~time history
  in
  let made adapter =
    let part = Several.Part ((module Process_platform), adapter) in
    let leave () = Process_platform.leave adapter in
    (Process_platform.platform adapter, { part; estimates = adapter_estimates adapter; leave })
  in
  Lwt.map (Result.map made) opened

(* {1 Several} *)

let leave_all opened = Lwt.join (List.map (fun (_, one) -> one.leave ()) opened)

(* The adapters in their order, each with a name of its own. *)
let rec open_adapters s ~history opened = function
  | [] -> Lwt.return (Ok (List.rev opened))
  | command :: others -> (
      let give_up error = leave_all opened >>= fun () -> Lwt.fail error in
      Lwt.catch (fun () -> open_adapter s ~history ~taken:(List.map fst opened) command) give_up >>= function
      | Ok one -> open_adapters s ~history (one :: opened) others
      | Error why -> leave_all opened >|= fun () -> Error why)

let owners_of s =
  match s.past with None -> [] | Some (_, history) -> Several.owners ~imc:Udp_platform.name history

(* The first platform has the timers, and the vehicles that nothing was kept of. *)
let history_of s ~owners ~is_single =
  let first = ref None in
  fun name ->
    if !first = None then first := Some name;
    let is_first = !first = Some name in
    let is_mine v =
      match List.assoc_opt v owners with Some owner -> owner = name | None -> is_first in
    match s.past with
    | None -> []
    | Some (_, history) when is_single -> history
    | Some (_, history) -> History.part ~vehicles:is_mine ~timers:is_first history

let missing owners opened =
  let is_missing (_, name) = not (List.mem_assoc name opened) in
  match List.find_opt is_missing owners with
  | None -> None
  | Some (v, name) ->
    Some
      (Printf.sprintf "this run commanded %s over the platform %s; there is only %s: start the adapter of that name" v
         name
         (String.concat ", " (List.map fst opened)))

let combine s ~owners opened =
  match opened with
  | [ (_, one) ] -> one
  | several ->
    let parts = List.map (fun (name, one) -> (name, one.part)) several in
    let platform = Several.make ~note:(fun v -> s.note (Some v)) ~keep:s.keep ~owners parts in
    { part = Several.Part ((module Several), platform);
      estimates = (fun () -> List.concat_map (fun (_, one) -> one.estimates ()) several);
      leave = (fun () -> leave_all several) }

let open_ choice s =
  let owners = owners_of s in
  let is_single = List.length choice.adapters + Option.fold choice.imc ~none:0 ~some:(fun _ -> 1) = 1 in
  let history = history_of s ~owners ~is_single in
  let imc =
    match choice.imc with
    | None -> Lwt.return (Ok [])
    | Some options -> Lwt.map (Result.map (fun one -> [ one ])) (open_imc s ~history options)
  in
  imc >>= function
  | Error why -> Lwt.return (Error why)
  | Ok imc -> (
      open_adapters s ~history imc choice.adapters >>= function
      | Error why -> Lwt.return (Error why)
      | Ok opened -> (
          match missing owners opened with
          | Some why -> leave_all opened >|= fun () -> Error why
          | None -> Lwt.return (Ok (combine s ~owners opened))))
