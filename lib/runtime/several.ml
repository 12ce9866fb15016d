open Dolphin_semantics
open Lwt.Infix

type part = Part : (module Platform.S with type t = 'p) * 'p -> part

type one = { name : string; part : part; mutable upcoming : Platform.event Lwt.t option }

(* A vehicle: its commanding platform, and the last report of each platform that has offered it. *)
type vehicle = { mutable owner : int; mutable offers : (int * World.vehicle_state) list; mutable told : bool }

type t = {
  parts : one array;
  note : Core.vehicle -> string -> unit;
  keep : time:float -> Core.vehicle -> Yojson.Safe.t -> unit;
  vehicles : (Core.vehicle, vehicle) Hashtbl.t;
  bound : (Core.vehicle, unit) Hashtbl.t;
  mutable turn : int;  (* the part whose event is read first, if several have one *)
}

let name = "several"
let virtual_time = false
let order = World.By_id

let index_of parts name =
  let rec go i = if i = Array.length parts then None else if parts.(i).name = name then Some i else go (i + 1) in
  go 0

let make ~note ~keep ~owners parts =
  let parts = Array.of_list (List.map (fun (name, part) -> { name; part; upcoming = None }) parts) in
  let vehicles = Hashtbl.create 16 in
  let add (v, name) =
    Option.iter (fun owner -> Hashtbl.replace vehicles v { owner; offers = []; told = false }) (index_of parts name)
  in
  List.iter add owners;
  { parts; note; keep; vehicles; bound = Hashtbl.create 16; turn = 0 }

(* {1 All of them} *)

type 'a each = { each : 'p. (module Platform.S with type t = 'p) -> 'p -> 'a }

let at s i { each } = match s.parts.(i).part with Part (platform, p) -> each platform p
let all s each = List.init (Array.length s.parts) (fun i -> at s i each)
let first s each = at s 0 each

let now s = first s { each = (fun (type p) (module P : Platform.S with type t = p) p -> P.now p) }

let announce_period s =
  let period (type p) (module P : Platform.S with type t = p) p = P.announce_period p in
  List.fold_left Float.max 0. (all s { each = period })

let set_timer s timer seconds =
  first s { each = (fun (type p) (module P : Platform.S with type t = p) p -> P.set_timer p timer seconds) }

(* Of the events that platforms have reported and that are unread. *)
let drop s overtaken =
  Array.iter (fun one -> one.upcoming <- Overtaken.left overtaken one.upcoming) s.parts

let cancel_timer s timer =
  drop s (Overtaken.by_cancel timer);
  first s { each = (fun (type p) (module P : Platform.S with type t = p) p -> P.cancel_timer p timer) }

let telemetry s how =
  ignore (all s { each = (fun (type p) (module P : Platform.S with type t = p) p -> P.telemetry p how) })

let look s = List.concat (all s { each = (fun (type p) (module P : Platform.S with type t = p) p -> P.look p) })

let close s =
  Lwt.join (all s { each = (fun (type p) (module P : Platform.S with type t = p) p -> P.close p) })

(* {1 Commands} *)

(* One that was not offered yet is asked for at the platform with the most vehicles. *)
let owner s v = match Hashtbl.find_opt s.vehicles v with Some vehicle -> vehicle.owner | None -> 0

let of_owner s i vehicles = List.filter (fun v -> owner s v = i) vehicles

let each_with_own s vehicles each =
  let of_part i = match of_owner s i vehicles with [] -> () | own -> at s i (each own) in
  List.iter of_part (List.init (Array.length s.parts) Fun.id)

let bind s vehicles =
  let keep v =
    Hashtbl.replace s.bound v ();
    s.keep ~time:(now s) v (`Assoc [ ("platform", `String s.parts.(owner s v).name) ])
  in
  List.iter keep vehicles;
  each_with_own s vehicles (fun own ->
      { each = (fun (type p) (module P : Platform.S with type t = p) p -> P.bind p own) })

let release s vehicles =
  List.iter (Hashtbl.remove s.bound) vehicles;
  each_with_own s vehicles (fun own ->
      { each = (fun (type p) (module P : Platform.S with type t = p) p -> P.release p own) })

let start s ~number v task =
  at s (owner s v) { each = (fun (type p) (module P : Platform.S with type t = p) p -> P.start p ~number v task) }

let stop s v =
  drop s (Overtaken.by_stop v);
  at s (owner s v) { each = (fun (type p) (module P : Platform.S with type t = p) p -> P.stop p v) }

let set_connection_timeout s vehicles seconds =
  let set vehicles =
    { each = (fun (type p) (module P : Platform.S with type t = p) p -> P.set_connection_timeout p vehicles seconds) }
  in
  match vehicles with
  | None -> ignore (all s (set None))
  | Some vs -> each_with_own s vs (fun own -> set (Some own))

(* {1 Events} *)

let offering vehicle =
  let connected (_, (state : World.vehicle_state)) = state.connected in
  List.sort compare (List.map fst (List.filter connected vehicle.offers))

let names s indices = String.concat " and by " (List.map (fun i -> s.parts.(i).name) indices)

(* Whose platform has gone belongs to another one that offers it, unless the program holds it. *)
let settle_owner s v vehicle offering =
  if (not (List.mem vehicle.owner offering)) && not (Hashtbl.mem s.bound v) then
    match offering with i :: _ -> vehicle.owner <- i | [] -> ()

let see s i (state : World.vehicle_state) =
  let vehicle =
    match Hashtbl.find_opt s.vehicles state.id with
    | Some vehicle -> vehicle
    | None ->
      let vehicle = { owner = i; offers = []; told = false } in
      Hashtbl.replace s.vehicles state.id vehicle;
      vehicle
  in
  vehicle.offers <- (i, state) :: List.remove_assoc i vehicle.offers;
  let offering = offering vehicle in
  settle_owner s state.id vehicle offering;
  let several = List.length offering > 1 in
  let why = "is offered by " ^ names s offering in
  if several && not vehicle.told then s.note state.id (why ^ ": it cannot be picked until only one does");
  vehicle.told <- several;
  let shown (state : World.vehicle_state) = if several then { state with unready = Some why } else state in
  Option.map (fun state -> Platform.Vehicle (shown state)) (List.assoc_opt vehicle.owner vehicle.offers)

let event s i : Platform.event -> Platform.event option = function
  | Vehicle state -> see s i state
  | (Task_done v | Task_failed (v, _)) as event -> if owner s v = i then Some event else None
  | Timer _ as event -> if i = 0 then Some event else None
  | Input _ as event -> Some event
  | Quiet -> None

let upcoming s i =
  let one = s.parts.(i) in
  match one.upcoming with
  | Some promise -> promise
  | None ->
    let promise =
      at s i { each = (fun (type p) (module P : Platform.S with type t = p) p -> P.next p) } in
    one.upcoming <- Some promise;
    promise

(* The parts take turns: one that always has an event does not keep the ends of the others' tasks away. *)
let rec next s =
  let n = Array.length s.parts in
  let promises = List.map (fun i -> (i, upcoming s i)) (List.init n (fun i -> (s.turn + i) mod n)) in
  let is_there (_, promise) = Lwt.state promise <> Lwt.Sleep in
  match List.find_opt is_there promises with
  | None -> Lwt.choose (List.map (fun (_, promise) -> Lwt.protected promise) promises) >>= fun _ -> next s
  | Some (i, promise) -> (
      s.parts.(i).upcoming <- None;
      s.turn <- (i + 1) mod n;
      promise >>= fun e -> match event s i e with Some e -> Lwt.return e | None -> next s)

(* {1 Resumption} *)

let owners ~imc history =
  let owner : Yojson.Safe.t -> string = function `Assoc (("platform", `String name) :: _) -> name | _ -> imc in
  let add found { History.what; time = _ } =
    match what with
    | Noted (v, note) -> (v, owner note) :: List.remove_assoc v found
    | Saw _ | Happened _ | Asked _ -> found
  in
  List.fold_left add [] history
