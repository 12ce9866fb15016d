open Dolphin_imc
open Station_state

let most_nodes = Crowd.most_nodes
let longest_name = 200

let drop reason s =
  let one = function None -> Some 1 | Some n -> Some (n + 1) in
  ({ s with dropped = Names.update reason one s.dropped }, [])

let skip s = ({ s with skipped = s.skipped + 1 }, [])

(* The messages that some part here reads. *)
let is_wanted id =
  id = Message.Announce.id || id = Message.Heartbeat.id || id = Message.Estimated_state.id
  || id = Message.Vehicle_state.id || id = Message.Plan_control_state.id || id = Message.Plan_control.id
  || id = Message.Fuel_level.id || id = Message.Log_book_entry.id || id = Message.Entity_list.id
  || id = Message.Abort.id || id = Message.Entity_parameters.id
  || Measurement.is_id id

let request_of ~id s = (s.settings.first_request + (id * 257)) land 0xFFFF

(* A new system: it gets our announcement at once. *)
let introduce ~now (n : Node.t) s =
  let directly =
    if n.hosts = [ Unix.inet_addr_loopback ] then []
    else List.map (fun host -> Announce_to (host, announcement ~now s)) n.hosts
  in
  let presence, is_due = Presence.met ~now s.presence in
  ({ s with presence }, if is_due then Announce (announcement ~now s) :: directly else directly)

(* A system with several links, which is heard from each of them in turn, keeps its address. *)
let is_elsewhere ~(before : Node.t) (n : Node.t) =
  match before.address, n.address with
  | _, None -> false
  | None, Some _ -> true
  | Some was, Some address -> address.port <> was.port || not (Node.belongs address.host before)

(* Systems that come and go with new names do not make people read without end. *)
let most_warnings = 100

let warn (n : Node.t) (warning : Node.warning option) s =
  match warning with
  | None -> (s, [])
  | Some { about; text } ->
    let key = n.name ^ "\n" ^ about in
    if Name_set.mem key s.warned || Name_set.cardinal s.warned >= most_warnings then (s, [])
    else ({ s with warned = Name_set.add key s.warned }, [ Remark (n.name, text) ])

let dropped reason s outputs =
  let s, _ = drop reason s in
  (s, outputs)

(* A system that is heard of for the first time. *)
let newcomer ~now ~from (p : Packet.t) (a : Message.Announce.t) s =
  let is_full = Systems.cardinal s.systems >= most_nodes in
  let told name text = if s.crowded then [] else [ Remark (name, text) ] in
  match Crowd.make_room ~now s with
  | None ->
    let text = Printf.sprintf "is not listened to: %d systems are known already" most_nodes in
    dropped "too many systems" { s with crowded = true } (told a.sys_name text)
  | Some s ->
    let n = Node.make ~now ~from ?abort_after:s.settings.abort_after ~request:(request_of ~id:p.src s) p a in
    let crowded = s.crowded || is_full in
    let s = { s with systems = Systems.announced n s.systems; accepted = s.accepted + 1; crowded } in
    (* In a crowd, the program only gets the systems that speak. *)
    let s = if crowded then s else tell ~now n s in
    let text = Printf.sprintf "is one of over %d systems: others, which have not spoken, are forgotten" most_nodes in
    let told = if is_full then told n.name text else [] in
    if n.address = None then (s, told)
    else
      let s, greetings = introduce ~now n s in
      (s, told @ greetings)

let announced_again ~now ~from (p : Packet.t) (a : Message.Announce.t) (before : Node.t) s =
  let may_rename = not (Crowd.wants before.name s) && Execution.is_settled ~now before.execution in
  match Node.announce ~now ~from ~may_rename p a before with
  | Other (n, warning) ->
    let s, sent = warn n warning (tell ~now n (update n s)) in
    dropped "foreign address" s sent
  | Own (n, warning) ->
    let s = if n.name = before.name then s else gone before s in
    let s = tell ~now n { s with systems = Systems.announced n s.systems; accepted = s.accepted + 1 } in
    let s, sent = warn n warning s in
    let s, greetings = if is_elsewhere ~before n then introduce ~now n s else (s, []) in
    (s, sent @ greetings)

let announced ~now ~from (p : Packet.t) (a : Message.Announce.t) s =
  if String.length a.sys_name > longest_name then drop "announcement too long" s
  else
    match Systems.taken ~now ~id:p.src a.sys_name s.systems with
    | Some owner ->
      let other = Printf.sprintf "0x%04x at %s" p.src (Unix.string_of_inet_addr from) in
      let text =
        Printf.sprintf "two systems have this name: 0x%04x, which is %s, and %s, which is ignored" owner.id
          (Node.place owner) other
      in
      let s, sent = warn owner (Some { about = other; text }) s in
      dropped "name of another" s sent
    | None -> (
        match Systems.find_id p.src s.systems with
        | None -> newcomer ~now ~from p a s
        | Some before -> announced_again ~now ~from p a before s)

let name_of id s =
  match Systems.find_id id s.systems with Some n -> n.name | None -> Printf.sprintf "system 0x%04x" id

let aborted ~now (p : Packet.t) s =
  match Systems.find_id p.dst s.systems with
  | Some n -> command ~now (Abort (name_of p.src s)) n s
  | None -> (s, [])

(* The action for an expected vehicle is taken once it has reported its plan. *)
let take_over ~now (n : Node.t) s =
  if Execution.report n.execution = None || listens ~now s then (s, [])
  else
    let inputs, expected = Expected.heard n.name s.expected in
    let s = { s with expected } in
    match taken_by_another n.name s with
    | None -> command_all ~now inputs n s
    | Some _ when inputs = [] -> (s, [])
    (* Its plan is another's now. *)
    | Some why -> (push (Task_failed (n.name, why)) s, [])

(* The payload that it announces, and does not list. *)
let missing_devices (before : Node.t) (n : Node.t) s =
  match before.entities, n.entities, List.assoc_opt n.name s.settings.payload with
  | None, Some listed, Some claimed ->
    let listed = List.map String.lowercase_ascii listed in
    List.filter (fun device -> not (List.mem (String.lowercase_ascii device) listed)) claimed
  | _, _, _ -> []

let remark_on_payload before n s =
  match missing_devices before n s with
  | [] -> []
  | devices ->
    [ Remark (n.name, Printf.sprintf "does not list %s among its entities, as --imc-payload has it"
                (String.concat ", " devices)) ]

let heard ~now (p : Packet.t) (n : Node.t) s =
  let before = n in
  let first = n.last_heard = neg_infinity in
  let n, outputs = Node.hear ~now ~jitter:s.settings.jitter ~own:s.settings.id p n in
  let s, sent = carry_out ~now n outputs (update n { s with accepted = s.accepted + 1 }) in
  let s, more = take_over ~now n s in
  let n = again n s in
  let sent = remark_on_payload before n s @ sent in
  if first && Node.is_vehicle n then
    let at = now +. Presence.eager_heartbeat_interval in
    let s, queried = query ~now n { s with presence = Presence.hasten ~at s.presence } in
    (s, sent @ more @ queried)
  else (s, sent @ more)

(* Vehicles send on to all consoles what one of them requests. *)
let request_of_another ~now (vehicle : Node.t) (p : Packet.t) s =
  match p.content with
  | Message (Plan_control { type_ = Request; op = Stop; _ }) ->
    command ~now (Stopped_by (name_of p.src s)) vehicle { s with accepted = s.accepted + 1 }
  | Message _ | Unknown _ -> skip s

(* Of two consoles that want the same, the one that was resumed or slept gives way; else that of the higher address. *)
let gives_way ~now (n : Node.t) s =
  let listens_there = match n.claim with Some (_, claim) -> claim.resuming | None -> false in
  match listens ~now s, listens_there with
  | true, false -> true
  | false, true -> false
  | true, true | false, false -> n.id < s.settings.id

(* Of two that have one run, by a copy of its journal, one goes on. *)
let with_twin ~now (n : Node.t) s = if gives_way ~now n s then { s with twin = Some n.name } else s

(* Those that the console [n] had first, or that two want and it gets. *)
let yielded ~now (n : Node.t) s =
  let is_lost v = Name_set.mem v s.bound && now < deferred_until v s && gives_way ~now n s in
  { s with yielded = List.fold_left (fun set v -> Name_set.add v set) s.yielded (List.filter is_lost (held_by n)) }

let let_go ~now vehicles s =
  let one s v =
    match find v s with
    | Some n when not (Names.mem v s.held || Name_set.mem v s.bound) ->
      update (Node.let_go ~now ~jitter:s.settings.jitter n) s
    | Some _ | None -> s
  in
  List.fold_left one s vehicles

let claimed_by_other_run ~now (before : Node.t) (n : Node.t) s =
  let s = yielded ~now n s in
  let held = held_by n and held_before = held_by before in
  if held = held_before then (s, [])
  else
    let s = let_go ~now held_before (with_claims s) in
    let conflict v =
      match n.claim with
      | Some (_, claim) when Name_set.mem v s.bound && not (List.mem v held_before) ->
        Some (Remark (v, "also " ^ Claim.obstacle ~console:n.name claim))
      | Some _ | None -> None
    in
    (tell_all ~now (held @ held_before) s, List.filter_map conflict held)

let claimed ~now (before : Node.t) s =
  let n = again before s in
  if is_of_this_run n s then (with_twin ~now n s, []) else claimed_by_other_run ~now before n s

let packet ~now ~from (p : Packet.t) s =
  match p.content with
  | Message (Announce a) -> announced ~now ~from p a s
  | Message _ | Unknown _ -> (
      match Systems.find_id p.src s.systems with
      | None -> drop "unknown sender" s
      | Some n when not (Node.belongs from n) -> drop "foreign address" s
      | Some n -> (
          match p.content with
          | Message Abort -> aborted ~now p s
          | Message (Entity_parameters _) ->
            let s, sent = heard ~now p n s in
            let s, more = claimed ~now n s in
            (s, sent @ more)
          | Message _ | Unknown _ -> heard ~now p n s))

(* Of systems that have announced, from their addresses. *)
let record ~from (h : Header.t) bytes s =
  match Systems.find_id h.src s.systems with
  | Some n when s.settings.records && Node.belongs from n && Header.check h bytes = Ok () ->
    { s with received = Received.add h bytes s.received }
  | Some _ | None -> s

(* After a longer gap it is for a tick to find out that the console slept. *)
let dated ~now s = if now -. s.seen <= longest_pause then { s with seen = Float.max now s.seen } else s

let datagram ~now ~from ?len bytes s =
  let s = dated ~now s in
  let header = Header.read ?len bytes in
  let s = match header with Ok h -> record ~from h bytes s | Error _ -> s in
  let decoded f =
    match Packet.decode ?len bytes with
    | Error why -> drop (Error.label why) s
    | Ok p -> f { p with content = Door.content p.content }
  in
  match header with
  | Error why -> drop (Error.label why) s
  | Ok h when not (is_wanted h.id) -> skip s
  | Ok h when h.src = s.settings.id -> drop "our own" s
  | Ok h when h.id = Message.Plan_control.id && h.dst <> s.settings.id -> (
      match Systems.find_id h.dst s.systems with
      | Some vehicle when h.src <> h.dst && Node.belongs from vehicle ->
        decoded (fun p -> request_of_another ~now vehicle p s)
      | Some _ | None -> skip s)
  | Ok _ -> decoded (fun p -> packet ~now ~from p s)
