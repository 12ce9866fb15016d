module String_map = Map.Make (String)
module Int_map = Map.Make (Int)

type vehicle_state = {
  id : Core.vehicle;
  kind : string;
  payload : string list;
  position : Dolphin_geo.Position.t;
  battery : float;
  connected : bool;
}

type t = { ranks : int String_map.t; states : vehicle_state Int_map.t }

let empty = { ranks = String_map.empty; states = Int_map.empty }

let add state world =
  match String_map.find_opt state.id world.ranks with
  | Some rank -> { world with states = Int_map.add rank state world.states }
  | None ->
    let rank = match Int_map.max_binding_opt world.states with Some (last, _) -> last + 1 | None -> 0 in
    { ranks = String_map.add state.id rank world.ranks; states = Int_map.add rank state world.states }

let find id world =
  Option.map (fun rank -> Int_map.find rank world.states) (String_map.find_opt id world.ranks)

let vehicles world = List.map snd (Int_map.bindings world.states)

let carries devices state =
  let lower = String.lowercase_ascii in
  let carried = List.map lower state.payload in
  List.for_all (fun device -> List.mem (lower device) carried) devices
