open Dolphin_semantics
open Dolphin_environment
module Vehicle_map = Configuration.Vehicle_map

(* Of vehicles that are not alone. *)
type t = Core.vehicle array Vehicle_map.t

let none = Vehicle_map.empty
let is_none = Vehicle_map.is_empty
let of_vehicle p v = Option.value (Vehicle_map.find_opt v p) ~default:[||]

(* [vehicles] by what [key] says, in their order. *)
let grouped key vehicles =
  let classes = Hashtbl.create 16 in
  let add v =
    let k = key v in
    Hashtbl.replace classes k (v :: Option.value (Hashtbl.find_opt classes k) ~default:[])
  in
  List.iter add (List.rev vehicles);
  let member members p v = Vehicle_map.add v members p in
  let add _ members p =
    if List.compare_length_with members 1 > 0 then List.fold_left (member (Array.of_list members)) p members else p
  in
  Hashtbl.fold add classes none

let split f p =
  let is_first v (members : Core.vehicle array) = String.equal members.(0) v in
  let classes = Vehicle_map.filter is_first p in
  let union _ members _ = Some members in
  Vehicle_map.fold
    (fun _ members found -> Vehicle_map.union union (grouped f (Array.to_list members)) found)
    classes none

(* What [look] may show of a vehicle. *)
let shown look world state = List.map snd (World.cases world (fun world -> look world state))

(* Letters that readings of sensors are not spelled with: what is read of different vehicles is never the same text. *)
let is_plain id =
  String.for_all (function 'a' .. 'z' | 'A' .. 'Z' | '0' .. '9' | '-' | '_' | '.' -> true | _ -> false) id

(* What can be known of a vehicle, to be compared. *)
let known (options : Environment.options) world (sight : Name_flow.t) (s : World.vehicle_state) =
  let looks_at seen f = if seen then Some (f ()) else None in
  let place = looks_at sight.places (fun () -> (s.position, shown World.position world s)) in
  let battery = looks_at sight.batteries (fun () -> shown World.battery world s) in
  let endings = List.map (options.endings s.id) sight.texts in
  let is_odd = World.is_open world && (sight.places || sight.batteries) && not (is_plain s.id) in
  let alone = if is_odd || List.mem s.id sight.texts then Some s.id else None in
  ((s.kind, s.payload, s.connected), place, battery, endings, alone)

let find (options : Environment.options) program ~asked world =
  let sight = Name_flow.of_program program ~asked:(List.map Condition.closure asked) in
  let sight = { sight with texts = List.concat_map Condition.vehicles asked @ sight.texts } in
  let nobody_is_late = match options.latecomers with Never | At_most 0 -> true | At_most _ | Any_number -> false in
  let is_blind = sight.named = None && not (World.is_open world && sight.spelled <> None) in
  if not (nobody_is_late && is_blind && sight.picks) then none
  else
    let states = World.vehicles world in
    let known_of = Hashtbl.create 16 in
    List.iter (fun (s : World.vehicle_state) -> Hashtbl.add known_of s.id (known options world sight s)) states;
    grouped (Hashtbl.find known_of) (List.map (fun (s : World.vehicle_state) -> s.id) states)
