open Dolphin_imc
open Dolphin_platform_sim

type destination = Discovery | System of Address.t
type datagram = { destination : destination; bytes : string }

(* On its way. *)
type passage =
  | Outward of datagram
  | Inward of { channel : Vehicle_node.channel; host : string; bytes : string }

type t = {
  faults : Link_faults.t;
  seed : int;
  node : Vehicle_node.t;
  queue : passage Event_queue.t;
  sent : int;
  received : int;
}

type outcome = datagram list * Activity.t list * t

let create ?(faults = Link_faults.none) ~seed settings =
  { faults; seed; node = Vehicle_node.create settings; queue = Event_queue.empty; sent = 0; received = 0 }

let node r = r.node

(* {1 Out} *)

let link r direction = Vehicle_node.name r.node ^ direction

let schedule ~at passage r delays =
  let add queue delay = snd (Event_queue.add (at +. delay) passage queue) in
  { r with queue = List.fold_left add r.queue delays }

let transmit ~at r datagram =
  let delays = Link_faults.delays ~seed:r.seed ~link:(link r " sends") ~number:r.sent r.faults in
  let r = { r with sent = r.sent + 1 } in
  match delays with [ 0. ] -> [ datagram ], r | delays -> [], schedule ~at (Outward datagram) r delays

let datagrams (output : Vehicle_node.output) =
  match Packet.encode output.packet with
  | Error _ -> []
  | Ok bytes -> (
      match output.destination with
      | Discovery -> [ { destination = Discovery; bytes } ]
      | Systems systems -> List.map (fun system -> { destination = System system; bytes }) systems)

let transmit_all ~at r outputs =
  let one (sent, r) datagram =
    let now, r = transmit ~at r datagram in
    List.rev_append now sent, r
  in
  let sent, r = List.fold_left one ([], r) (List.concat_map datagrams outputs) in
  List.rev sent, r

let after_node ~at r (outputs, activities, node) =
  let sent, r = transmit_all ~at { r with node } outputs in
  sent, activities, r

let tell ~at ~src_ent ~content r =
  let outputs, node = Vehicle_node.tell ~at ~src_ent ~content r.node in
  after_node ~at r (outputs, [], node)

(* {1 In} *)

let arrive ~at channel ~host bytes r =
  match Packet.decode bytes with
  | Ok packet -> after_node ~at r (Vehicle_node.receive ~at channel ~host packet r.node)
  | Error _ -> [], [], r

let both (sent, activities, r) step =
  let more_sent, more_activities, r = step r in
  sent @ more_sent, activities @ more_activities, r

let pass ~at passage r =
  match passage with
  | Outward datagram -> [ datagram ], [], r
  | Inward { channel; host; bytes } -> arrive ~at channel ~host bytes r

let rec deliver ~at r =
  match Event_queue.first r.queue with
  | Some (time, passage) when time <= at ->
    both (pass ~at passage { r with queue = Event_queue.rest r.queue }) (deliver ~at)
  | Some _ | None -> [], [], r

let advance ~at r = both (deliver ~at r) (fun r -> after_node ~at r (Vehicle_node.advance ~at r.node))

let receive ~at channel ~host bytes r =
  both (advance ~at r) (fun r ->
      let delays = Link_faults.delays ~seed:r.seed ~link:(link r " receives") ~number:r.received r.faults in
      let r = { r with received = r.received + 1 } in
      match delays with
      | [ 0. ] -> arrive ~at channel ~host bytes r
      | delays -> [], [], schedule ~at (Inward { channel; host; bytes }) r delays)

let due r =
  match Event_queue.first r.queue, Vehicle_node.due r.node with
  | Some (time, _), Some time' -> Some (Float.min time time')
  | Some (time, _), None -> Some time
  | None, due -> due
