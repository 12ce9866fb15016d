module Int_map = Map.Make (Int)

(* [in_contact] once the contact was seen. *)
type peer = { name : string; addresses : Address.t list; chosen : Address.t option; heard : float; in_contact : bool }
type t = { period : float; phase : float; peers : peer Int_map.t }

let empty ~period ~phase = { period; phase; peers = Int_map.empty }
let patience = 30.
let most = 64
let put id peer p = { p with peers = Int_map.add id peer p.peers }

let announced ~id ~name addresses p =
  match Int_map.find_opt id p.peers with
  | Some peer -> put id { peer with name } p
  | None when Int_map.cardinal p.peers >= most -> p
  | None -> put id { name; addresses; chosen = None; heard = neg_infinity; in_contact = false } p

let is_recent ~at peer = at -. peer.heard <= patience

let heard ~id ~host ~at p =
  match Int_map.find_opt id p.peers with
  | None -> p
  | Some peer -> (
      match List.find_opt (fun (a : Address.t) -> a.host = host) peer.addresses with
      | None -> p
      | Some address ->
        let in_contact = peer.in_contact && is_recent ~at peer in
        put id { peer with chosen = Some address; heard = at; in_contact } p)

(* When the vehicle looks at a contact that was made at [time]. *)
let next_look p time =
  if p.period <= 0. then time else p.phase +. (p.period *. Float.ceil ((time -. p.phase) /. p.period))

let is_new peer = (not peer.in_contact) && peer.heard > neg_infinity

let due p =
  let earliest _ peer due =
    if is_new peer then Some (Float.min (next_look p peer.heard) (Option.value due ~default:infinity)) else due
  in
  Int_map.fold earliest p.peers None

let look ~at p =
  match due p with
  | None -> None
  | Some time when time > at -> None
  | Some _ ->
    let seen = Int_map.filter (fun _ peer -> is_new peer && next_look p peer.heard <= at) p.peers in
    let see _ peer =
      (* Contact that was lost before it was looked at is forgotten. *)
      if is_recent ~at peer then { peer with in_contact = true } else { peer with heard = neg_infinity }
    in
    let peers = Int_map.union (fun _ seen _ -> Some seen) (Int_map.mapi see seen) p.peers in
    Some (List.map fst (Int_map.bindings (Int_map.filter (fun _ peer -> is_recent ~at peer) seen)), { p with peers })

let listeners ~at p =
  let add _ peer addresses =
    match peer.chosen with
    | Some address when peer.in_contact && is_recent ~at peer -> address :: addresses
    | Some _ | None -> addresses
  in
  List.rev (Int_map.fold add p.peers [])

let name id p = match Int_map.find_opt id p.peers with Some peer -> peer.name | None -> "unknown"
