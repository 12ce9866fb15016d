open Lwt.Infix
module Process_platform = Dolphin_platform_process.Process_platform
module Dispatch = Dolphin_platform_process.Dispatch

let vehicles adapters =
  let of_adapter adapter =
    List.map (fun v -> (Process_platform.platform adapter, v)) (Process_platform.vehicles adapter) in
  let by_id (_, (a : Dispatch.vehicle)) (_, (b : Dispatch.vehicle)) = compare a.state.id b.state.id in
  List.stable_sort by_id (List.concat_map of_adapter adapters)

let json (platform, (v : Dispatch.vehicle)) : Yojson.Safe.t =
  let optional make = function Some x -> make x | None -> `Null in
  let number x = `Float x and text x = `String x in
  let s = v.state in
  let placed x = if v.is_placed then number x else `Null in
  `Assoc
    [ ("id", text s.id); ("platform", text platform); ("type", text s.kind);
      ("latitude", placed s.position.latitude); ("longitude", placed s.position.longitude);
      ("height", placed s.position.height); ("battery", optional number v.battery);
      ("speed", optional number v.speed); ("payload", `List (List.map text s.payload)); ("linked", `Bool s.connected);
      ("available", `Bool (v.is_placed && Dolphin_semantics.World.is_ready s)); ("unready", optional text s.unready) ]

let heads = [ "VEHICLE"; "TYPE"; "PLATFORM"; "POSITION"; "BATTERY"; "SPEED"; "PAYLOAD"; "LINK"; "READY" ]

let row (platform, (v : Dispatch.vehicle)) =
  let s = v.state in
  let ready =
    if not s.connected then "-"
    else
      match s.unready with
      | Some why -> why
      | None -> if v.is_placed then "yes" else "its position is not known"
  in
  [ s.id; s.kind; platform;
    (if v.is_placed then Printf.sprintf "%.5f, %.5f" s.position.latitude s.position.longitude else "-");
    Option.fold v.battery ~none:"-" ~some:(fun share -> Printf.sprintf "%.0f%%" (100. *. share));
    Option.fold v.speed ~none:"-" ~some:(Printf.sprintf "%.1f m/s");
    (if s.payload = [] then "-" else String.concat ", " s.payload);
    (if s.connected then "yes" else "no link");
    ready ]

let lines adapters ~json:as_json =
  match vehicles adapters with
  | found when as_json -> [ Dolphin_json.Canonical.to_string (`List (List.map json found)) ]
  | [] -> [ "no vehicle was heard of" ]
  | found -> Dolphin_display.Text_table.lines heads (List.map row found)

let tell vehicle text =
  let text = match vehicle with Some v -> v ^ ": " ^ text | None -> text in
  prerr_endline ("dolphin: " ^ Dolphin_trace.Phrase.harmless text)

let rec open_all opened = function
  | [] -> Lwt.return (Ok (List.rev opened))
  | command :: later -> (
      let taken = List.map Process_platform.platform opened in
      let options = { (Process_platform.default ~command) with purpose = Look; taken; note = tell } in
      let leave_all () = Lwt_list.iter_p Process_platform.leave opened in
      let give_up error = leave_all () >>= fun () -> Lwt.fail error in
      Lwt.catch (fun () -> Process_platform.open_ options) give_up >>= function
      | Ok adapter ->
        Process_platform.telemetry adapter Shown;
        open_all (adapter :: opened) later
      | Error why -> leave_all () >|= fun () -> Error (Error.Unavailable why))

let listing adapters =
  let names = String.concat ", " (List.map Process_platform.platform adapters) in
  let patience = List.fold_left (fun most a -> Float.max most (Process_platform.announce_period a)) 0. adapters in
  { Listing.head = (fun () -> names ^ ": Ctrl-C ends"); lines = lines adapters; patience }

let run commands interruption ~as_json ~once ~seconds =
  Lwt_main.run
    (Interruption.unless interruption (fun () -> open_all [] commands) >>= function
      | None -> Lwt.return (Ok ())
      | Some (Error _ as error) -> Lwt.return error
      | Some (Ok adapters) ->
        Listing.show (listing adapters) interruption ~as_json ~once ~seconds >>= fun () ->
        Lwt_list.iter_p Process_platform.close adapters >|= fun () -> Ok ())
