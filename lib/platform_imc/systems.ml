module Ids = Map.Make (Int)
module Names = Map.Make (String)

type t = { nodes : Node.t Ids.t; ids : int Names.t }

let none = { nodes = Ids.empty; ids = Names.empty }
let find_id id x = Ids.find_opt id x.nodes
let find name x = Option.bind (Names.find_opt name x.ids) (fun id -> find_id id x)
let update (n : Node.t) x = { x with nodes = Ids.add n.id n x.nodes }

let announced (n : Node.t) x =
  let ids =
    match find_id n.id x with
    | Some before when before.name <> n.name -> Names.remove before.name x.ids
    | Some _ | None -> x.ids
  in
  update n { x with ids = Names.add n.name n.id ids }

let remove (n : Node.t) x =
  let ids = if Names.find_opt n.name x.ids = Some n.id then Names.remove n.name x.ids else x.ids in
  { nodes = Ids.remove n.id x.nodes; ids }

let taken ~now ~id name x =
  match find name x with
  | Some other when other.id <> id && now -. Node.last_sign other <= Node.absence -> Some other
  | Some _ | None -> None

let cardinal x = Ids.cardinal x.nodes
let exists p x = Ids.exists (fun _ n -> p n) x.nodes
let to_list x = List.map snd (Ids.bindings x.nodes)
