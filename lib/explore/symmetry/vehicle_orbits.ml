open Dolphin_semantics
open Dolphin_environment

(* The orbit of each vehicle that is not alone in its. *)
type t = Core.vehicle array Vehicle_map.t

let none = Vehicle_map.empty
let is_none = Vehicle_map.is_empty
let of_vehicle p v = Option.value (Vehicle_map.find_opt v p) ~default:[||]

(* {1 Naming} *)

type naming = {
  orbits : t;
  names : (Core.vehicle, Core.vehicle) Hashtbl.t;
  used : (Core.vehicle, int) Hashtbl.t;  (* by first of the orbit: how many of its names are given *)
}

let naming orbits = { orbits; names = Hashtbl.create 16; used = Hashtbl.create 16 }

let name n v =
  match of_vehicle n.orbits v, Hashtbl.find_opt n.names v with
  | [||], _ -> v
  | _, Some name -> name
  | orbit, None ->
    let next = Option.value (Hashtbl.find_opt n.used orbit.(0)) ~default:0 in
    Hashtbl.replace n.used orbit.(0) (next + 1);
    Hashtbl.add n.names v orbit.(next);
    orbit.(next)

let name_of n v = match of_vehicle n.orbits v with [||] -> Some v | _ -> Hashtbl.find_opt n.names v
let is_identity n = Hashtbl.fold (fun v name same -> same && String.equal v name) n.names true

(* {1 Finding orbits} *)

(* Vehicles with the same key are an orbit, in the order of [vehicles]. *)
let by_key key vehicles =
  let orbits = Hashtbl.create 16 in
  let add v =
    let k = key v in
    Hashtbl.replace orbits k (v :: Option.value (Hashtbl.find_opt orbits k) ~default:[])
  in
  List.iter add (List.rev vehicles);
  let member members p v = Vehicle_map.add v members p in
  let add _ members p =
    if List.compare_length_with members 1 > 0 then List.fold_left (member (Array.of_list members)) p members else p
  in
  Hashtbl.fold add orbits none

let split f p =
  let is_first v (members : Core.vehicle array) = String.equal members.(0) v in
  let orbits = Vehicle_map.filter is_first p in
  let union _ members _ = Some members in
  Vehicle_map.fold
    (fun _ members found -> Vehicle_map.union union (by_key f (Array.to_list members)) found)
    orbits none

(* An open sensor's reading is a text that names the vehicle and starts with another character: readings of different
   vehicles differ. *)
let is_plain id =
  String.for_all (function 'a' .. 'z' | 'A' .. 'Z' | '0' .. '9' | '-' | '_' | '.' -> true | _ -> false) id

(* All that a step may depend on but the name. *)
let key (options : Environment.options) world (flow : Name_flow.t) ~named (s : World.vehicle_state) =
  let if_read is_read f = if is_read then Some (f ()) else None in
  let place = if_read flow.places (fun () -> (s.position, World.position world s)) in
  let sensors = if_read flow.sensors (fun () -> World.sensors world s) in
  let abilities = if_read flow.abilities (fun () -> (s.cruise, s.drain)) in
  let endings = List.map (Environment.ending options s.id) flow.texts in
  let is_odd = World.is_open world && (flow.places || flow.sensors) && not (is_plain s.id) in
  let alone = if is_odd || named s.id || List.mem s.id flow.texts then Some s.id else None in
  let may_be_late = Faults.is_possible options.faults.join && options.may_be_late s.id in
  ((s.kind, s.payload, s.connected, may_be_late), place, (sensors, abilities), endings, alone)

(* Vehicles and texts among what may be posted. *)
let posted (options : Environment.options) =
  let rec names : Core.value -> string list = function
    | Vehicles vs -> vs
    | String text -> [ text ]
    | List xs -> List.concat_map names (Vector.to_list xs)
    | Map entries -> List.concat_map (fun (_, x) -> names x) entries
    | Null | Boolean _ | Integer _ | Number _ | Wildcard | Symbol _ | Range _ | Position _ | Area _ | Task _ | Closure _
    | Host _ | Settings _ | Reading _ | Unknown _ -> []
  in
  let of_input (i : Environment.input) = List.concat_map names (List.concat i.rounds) in
  List.concat_map of_input options.inputs

let find (options : Environment.options) program ~asked ?(named = fun _ -> false) world =
  let flow = Name_flow.of_program program ~asked:(List.map Condition.closure asked) in
  let flow = { flow with texts = List.concat_map Condition.vehicles asked @ posted options @ flow.texts } in
  let is_independent = flow.names = None && not (World.is_open world && flow.readings <> None) in
  if not (is_independent && flow.picks) then none
  else
    let states = World.vehicles world in
    let keys = Hashtbl.create 16 in
    List.iter (fun (s : World.vehicle_state) -> Hashtbl.add keys s.id (key options world flow ~named s)) states;
    by_key (Hashtbl.find keys) (List.map (fun (s : World.vehicle_state) -> s.id) states)
