module String_map = Map.Make (String)
module Int_map = Map.Make (Int)
module Position = Dolphin_geo.Position

module Sensor_map = Map.Make (struct
    type t = Core.vehicle * Core.sensor

    let compare = Stdlib.compare
  end)

type vehicle_state = {
  id : Core.vehicle;
  kind : string;
  payload : string list;
  position : Position.t;
  depth : float option;
  altitude : float option;
  battery : float option;
  speed : float option;
  readings : (string * float) list;
  connected : bool;
  unready : string option;
  cruise : float option;
  drain : float option;
  progress : (string * float) list;
}

type assumption =
  | Late of Core.vehicle
  | Missing of Core.vehicle
  | Sensed of Core.sensor * Core.vehicle * Core.value
  | Placed of Core.vehicle * Position.t
  | Claim of string * bool

let compare_assumption a b =
  let rank = function Late _ -> 0 | Missing _ -> 1 | Sensed _ -> 2 | Placed _ -> 3 | Claim _ -> 4 in
  match a, b with
  | Late v, Late w | Missing v, Missing w -> String.compare v w
  | Sensed (s, v, x), Sensed (s', w, y) ->
    Order.both (Stdlib.compare (s, v) (s', w)) (fun () -> Value.compare x y)
  | Placed (v, p), Placed (w, q) -> Order.both (String.compare v w) (fun () -> Position.compare p q)
  | Claim (text, b), Claim (text', b') -> Order.both (String.compare text text') (fun () -> Bool.compare b b')
  | (Late _ | Missing _ | Sensed _ | Placed _ | Claim _), _ -> Int.compare (rank a) (rank b)

(* Vehicles by their rank in the order of first hearing; [states] has each rank that [ranks] has. *)
type order = By_hearing | By_id
type date = Exactly of int | Since of int | Any

type t = {
  order : order;
  ranks : int String_map.t;
  states : vehicle_state Int_map.t;
  sensors : Core.value list Sensor_map.t;  (* of the open ones: their possible values *)
  positions : Position.t list String_map.t;
  date : date;
  supposed : assumption list;  (* of sensors *)
}

let nobody order =
  { order; ranks = String_map.empty; states = Int_map.empty; sensors = Sensor_map.empty; positions = String_map.empty;
    date = Exactly 0; supposed = [] }

let empty = nobody By_hearing

let next_rank world =
  match Int_map.max_binding_opt world.states with Some (last, _) -> last + 1 | None -> 0

let add state world =
  match String_map.find_opt state.id world.ranks with
  | Some rank -> { world with states = Int_map.add rank state world.states }
  | None ->
    let rank = next_rank world in
    { world with ranks = String_map.add state.id rank world.ranks; states = Int_map.add rank state world.states }

let find id world =
  Option.map (fun rank -> Int_map.find rank world.states) (String_map.find_opt id world.ranks)

let vehicles world =
  match world.order with
  | By_hearing -> List.map snd (Int_map.bindings world.states)
  | By_id -> List.map (fun (_, rank) -> Int_map.find rank world.states) (String_map.bindings world.ranks)

let is_ready state = state.connected && state.unready = None

let only vs world =
  let states = List.filter_map (fun v -> find v world) vs in
  List.fold_left (fun w state -> add state w) { world with ranks = String_map.empty; states = Int_map.empty } states

let count world = Int_map.cardinal world.states

let carries devices state =
  let lower = String.lowercase_ascii in
  devices = []
  ||
  let carried = List.map lower state.payload in
  List.for_all (fun device -> List.mem (lower device) carried) devices

(* {1 Open worlds} *)

let contradict a b =
  match a, b with
  | Claim (text, holds), Claim (text', holds') -> Sensor_comparison.contradict (text, holds) (text', holds')
  | Sensed (s, v, x), Sensed (s', v', x') -> s = s' && String.equal v v' && Value.compare x x' <> 0
  | Placed (v, p), Placed (v', p') -> String.equal v v' && Position.compare p p' <> 0
  | (Late _ | Missing _ | Sensed _ | Placed _ | Claim _), _ -> false

let spell (s : Core.sensor) v =
  match s with
  | Battery -> Printf.sprintf "battery(%s)" v
  | Speed -> Printf.sprintf "speed(%s)" v
  | Connected -> Printf.sprintf "connected(%s)" v
  | Progress -> Printf.sprintf "progress(%s)" v
  | Measurement name -> Printf.sprintf "reading(%s,'%s')" v name

let pp_assumption ppf = function
  | Late v -> Format.fprintf ppf "%s comes late" v
  | Missing v -> Format.fprintf ppf "%s is missing" v
  | Sensed (s, v, x) -> Format.fprintf ppf "%s is %a" (spell s v) Value.pp (Value.canonical x)
  | Placed (v, p) -> Format.fprintf ppf "position(%s) is %a" v Position.pp p
  | Claim (text, holds) -> Format.fprintf ppf "%s is %b" text holds

let open_sensor s v xs world = { world with sensors = Sensor_map.add (v, s) xs world.sensors }
let open_battery v xs = open_sensor Battery v (List.map (fun x -> Core.Number x) xs)
let open_position v ps world = { world with positions = String_map.add v ps world.positions }
let whole seconds = int_of_float (Float.round (seconds *. 1000.)) / 1000
let at date world = if world.date = date then world else { world with date }
let date world = world.date

let is_open world =
  let is_dated = match world.date with Exactly _ -> true | Since _ | Any -> false in
  not (Sensor_map.is_empty world.sensors && String_map.is_empty world.positions && is_dated)

(* [v] with the state that [change] makes of its own, after all other vehicles. *)
let last v change world =
  match find v world with
  | None -> world
  | Some state ->
    let states = Int_map.remove (String_map.find v world.ranks) world.states in
    add (change state) { world with ranks = String_map.remove v world.ranks; states }

let suppose assumed world =
  let one world = function
    | Late v -> last v Fun.id world
    | Missing v -> last v (fun state -> { state with connected = false }) world
    | (Sensed _ | Placed _ | Claim _) as assumption -> { world with supposed = assumption :: world.supposed }
  in
  List.fold_left one world assumed

(* {1 What is looked at} *)

type 'a shown = Shows of 'a | One_of of 'a list | Anything
type question = assumption list

let shown opened known supposed world =
  match opened with
  | None -> Shows known
  | Some [] -> Anything
  | Some xs -> ( match List.find_map supposed world.supposed with Some x -> Shows x | None -> One_of xs)

let known (s : Core.sensor) state : Core.value option =
  let number = Option.map (fun x -> Core.Number x) in
  match s with
  | Battery -> number state.battery
  | Speed -> number state.speed
  | Connected -> Some (Boolean state.connected)
  | Progress -> Some (Number (match state.progress with (_, share) :: _ -> share | [] -> 0.))
  | Measurement name -> number (List.assoc_opt name state.readings)

let sensor world s state =
  let supposed = function Sensed (s', v, x) when v = state.id && s' = s -> Some x | _ -> None in
  let opened = Sensor_map.find_opt (state.id, s) world.sensors in
  Option.map (fun x -> shown opened x supposed world) (known s state)

let sensors world state =
  let measured = List.map (fun (name, _) -> Core.Measurement name) state.readings in
  List.map (fun s -> (s, sensor world s state)) (Core.Battery :: Speed :: Connected :: Progress :: measured)

let position world state =
  let supposed = function Placed (v, p) when v = state.id -> Some p | _ -> None in
  shown (String_map.find_opt state.id world.positions) state.position supposed world

let values s state xs = List.map (fun x -> Sensed (s, state.id, x)) xs
let places state ps = List.map (fun p -> Placed (state.id, p)) ps

let place world state =
  match position world state with
  | Shows p -> Ok p
  | Anything -> Ok state.position
  | One_of ps -> Error (places state ps)

let places_of world state =
  match position world state with Shows p -> [ p ] | One_of ps -> ps | Anything -> [ state.position ]

let claim world text =
  let yes = Claim (text, true) and no = Claim (text, false) in
  let excludes a = List.exists (contradict a) world.supposed in
  if world.supposed = [] then Error [ yes; no ]
  else if excludes no then Ok true
  else if excludes yes then Ok false
  else Error [ yes; no ]

let claims world = List.length (List.filter (function Claim _ -> true | _ -> false) world.supposed)
