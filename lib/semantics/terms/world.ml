module String_map = Map.Make (String)
module Int_map = Map.Make (Int)
module Position = Dolphin_geo.Position

type vehicle_state = {
  id : Core.vehicle;
  kind : string;
  payload : string list;
  position : Position.t;
  battery : float;
  connected : bool;
}

type assumption =
  | Late of Core.vehicle
  | Missing of Core.vehicle
  | Charged of Core.vehicle * float
  | Placed of Core.vehicle * Position.t
  | Claim of string * bool

(* Vehicles by their rank in the order of first hearing; [states] has each rank that [ranks] has. *)
type t = {
  ranks : int String_map.t;
  states : vehicle_state Int_map.t;
  batteries : float list String_map.t;  (* of those that are open: what they may show *)
  positions : Position.t list String_map.t;
  supposed : assumption list;  (* of sensors *)
}

let empty =
  { ranks = String_map.empty; states = Int_map.empty; batteries = String_map.empty; positions = String_map.empty;
    supposed = [] }

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

let vehicles world = List.map snd (Int_map.bindings world.states)

let carries devices state =
  let lower = String.lowercase_ascii in
  let carried = List.map lower state.payload in
  List.for_all (fun device -> List.mem (lower device) carried) devices

(* {1 Open worlds} *)

let pp_assumption ppf = function
  | Late v -> Format.fprintf ppf "%s comes late" v
  | Missing v -> Format.fprintf ppf "%s is missing" v
  | Charged (v, x) -> Format.fprintf ppf "battery(%s) is %g" v x
  | Placed (v, p) -> Format.fprintf ppf "position(%s) is %a" v Position.pp p
  | Claim (text, holds) -> Format.fprintf ppf "%s is %b" text holds

let open_battery v xs world = { world with batteries = String_map.add v xs world.batteries }
let open_position v ps world = { world with positions = String_map.add v ps world.positions }
let is_open world = not (String_map.is_empty world.batteries && String_map.is_empty world.positions)

(* The vehicle after all others, as [change] makes it. *)
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
    | (Charged _ | Placed _ | Claim _) as assumption -> { world with supposed = assumption :: world.supposed }
  in
  List.fold_left one world assumed

(* Raised where something is asked for that is neither known nor supposed: with all that may be supposed. *)
exception Open of assumption list

let rec cases world f =
  match f world with
  | result -> [ ([], result) ]
  | exception Open alternatives ->
    let further assumption =
      List.map
        (fun (assumed, result) -> (assumption :: assumed, result))
        (cases (suppose [ assumption ] world) f)
    in
    List.concat_map further alternatives

let outcomes ~equal world f =
  match cases world f with
  | [ ([], result) ] -> ( match result with Some result -> [ ([], result) ] | None -> [])
  | all -> (
      let add kept (assumed, result) =
        match result with
        | Some x when not (List.exists (fun (_, y) -> equal x y) kept) -> (assumed, x) :: kept
        | Some _ | None -> kept
      in
      match List.rev (List.fold_left add [] all) with
      | [ (_, x) ] when List.for_all (fun (_, result) -> result <> None) all -> [ ([], x) ]
      | kept -> kept)

(* {1 To look} *)

let battery world state =
  match String_map.find_opt state.id world.batteries with
  | None -> Some state.battery
  | Some [] -> None
  | Some xs -> (
      let shown = function Charged (v, x) when v = state.id -> Some x | _ -> None in
      match List.find_map shown world.supposed with
      | Some x -> Some x
      | None -> raise (Open (List.map (fun x -> Charged (state.id, x)) xs)))

let position world state =
  match String_map.find_opt state.id world.positions with
  | None -> Some state.position
  | Some [] -> None
  | Some ps -> (
      let seen = function Placed (v, p) when v = state.id -> Some p | _ -> None in
      match List.find_map seen world.supposed with
      | Some p -> Some p
      | None -> raise (Open (List.map (fun p -> Placed (state.id, p)) ps)))

let place world state = Option.value (position world state) ~default:state.position

let claimed world text =
  let made = function Claim (text', holds) when String.equal text text' -> Some holds | _ -> None in
  List.find_map made world.supposed

let claim world text =
  match claimed world text with
  | Some holds -> holds
  | None -> raise (Open [ Claim (text, true); Claim (text, false) ])

let claims world = List.length (List.filter (function Claim _ -> true | _ -> false) world.supposed)
