module Scenario = Dolphin_scenario.Scenario
module Battery = Dolphin_scenario.Battery

type t = { least : float; way : Timed_system.edge list option }

(* The knowledge where a state is entered: the range of the charge, from [low] to [high], when its course turned
   last; and its least charge now. By: the edge that lowered it last. *)
type known = { low : float; high : float; entry : float; by : Timed_system.edge option }

let slightly = 1e-9

(* Telemetry comes each second. *)
let age = 1.
let seconds ms = float ms /. 1000.
let cut x = Float.max 0. (Float.min 1. x)

type context = {
  vehicle : Scenario.vehicle;
  looks : bool;  (* whether what is seen of the battery is how full it is *)
  stays : Timed_system.stay array;
  fastest : float;  (* at which it changes in any state, a second *)
}

(* The greatest difference from the reading. *)
let blur c = slightly +. (c.fastest *. age)

let fastest vehicle stays =
  let change doing = Float.abs (Battery.rate vehicle doing) in
  let faster found (s : Timed_system.stay) = List.fold_left Float.max found (List.map change s.may_do) in
  Array.fold_left faster (Float.max (change Rests) (change Works)) stays

let rates c = List.map (Battery.rate c.vehicle)
let after rate ms from = cut (from +. (rate *. seconds ms))

(* The least charge, when the course has gone on for [least] to [most], in a state in which guards wait. *)
let lowest c ~may_do ~least ~most ~waited (k : known) =
  let rate = List.fold_left Float.min infinity (rates c may_do) in
  if rate >= 0. then Float.max k.entry (after rate least k.low)
  else
    let by_time = match most with Some ms -> after rate ms k.low | None -> 0. in
    let by_look = if c.looks && waited > 0. then Float.min k.entry (cut (waited -. blur c)) else 0. in
    Float.max by_time by_look

let highest c ~may_do ~least ~most (k : known) =
  let rate = List.fold_left Float.max neg_infinity (rates c may_do) in
  if rate <= 0. then after rate least k.high
  else match most with Some ms -> after rate ms k.high | None -> 1.

(* [None]: it does not have what is seen. *)
let over c (k : known) (e : Timed_system.edge) =
  let passed ({ may_do; least; most; turns; seen; binds = _ } : Timed_system.passage) =
    let seen = if c.looks then seen else Course.anything in
    let waited = c.stays.(e.source).waited in
    let low = Float.max (lowest c ~may_do ~least ~most ~waited k) (seen.above -. blur c) in
    let high = Float.min (highest c ~may_do ~least ~most k) (seen.below +. blur c) in
    if low > high +. slightly then None
    else if turns then Some { low; high; entry = low; by = Some e }
    else Some { k with entry = low; by = Some e }
  in
  Option.bind e.passage passed

let join (a : known) b =
  if b.low < a.low || b.high > a.high || b.entry < a.entry then
    Some { low = Float.min a.low b.low; high = Float.max a.high b.high; entry = Float.min a.entry b.entry;
           by = (if b.entry < a.entry then b.by else a.by) }
  else None

(* More rounds than these change a state only where it is come to again and again, with less each time. *)
let most_rounds = 30

let empty = { low = 0.; high = 1.; entry = 0.; by = None }

(* The knowledge about each state. Edges lead to states in [order] mostly. *)
let solve c n successors order =
  let known = Array.make n None in
  let is_changed = ref true and round = ref 0 in
  let reach (e : Timed_system.edge) k =
    let joined = match known.(e.target) with None -> Some k | Some before -> join before k in
    match joined with
    | Some k ->
      known.(e.target) <- Some (if !round > most_rounds then { empty with by = k.by } else k);
      is_changed := true
    | None -> ()
  in
  let follow v =
    let each k e = Option.iter (reach e) (over c k e) in
    Option.iter (fun k -> List.iter (each k) successors.(v)) known.(v)
  in
  let full = c.vehicle.battery in
  known.(0) <- Some { low = full; high = full; entry = full; by = None };
  while !is_changed do
    is_changed := false;
    incr round;
    List.iter follow order
  done;
  known

let least_of c v (k : known) =
  let { Timed_system.may_do; most; waited } = c.stays.(v) in
  Float.min k.entry (lowest c ~may_do ~least:0 ~most ~waited k)

(* By the edges that lowered it last, from the start, unless they go around. *)
let way known v =
  let rec back found left v =
    match known.(v) with
    | Some { by = Some (e : Timed_system.edge); _ } when left > 0 -> back (e :: found) (left - 1) e.source
    | Some { by = None; _ } -> Some found
    | Some _ | None -> None
  in
  back [] (Array.length known) v

(* The shortest way on from [v] to an end. *)
let onward successors is_end v =
  let entered = Array.make (Array.length successors) false in
  let rec go = function
    | [] -> None
    | (v, way) :: _ when is_end v -> Some (List.rev way)
    | (v, way) :: rest ->
      let next (e : Timed_system.edge) =
        if entered.(e.target) then None
        else begin
          entered.(e.target) <- true;
          Some (e.target, e :: way)
        end
      in
      go (rest @ List.filter_map next successors.(v))
  in
  go [ (v, []) ]

let binds_again (e : Timed_system.edge) = match e.passage with Some p -> p.binds | None -> false

let of_graph c ~is_end edges =
  let n = Array.length c.stays in
  let successors = Array.make n [] in
  List.iter (fun (e : Timed_system.edge) -> successors.(e.source) <- e :: successors.(e.source)) edges;
  let order = Longest.order n (fun v -> List.map (fun (e : Timed_system.edge) -> e.target) successors.(v)) in
  let known = solve c n successors order in
  let lower found v =
    match known.(v), found with
    | None, found -> found
    | Some k, Some (least, _) when least_of c v k >= least -> found
    | Some k, (Some _ | None) -> Some (least_of c v k, v)
  in
  let whole v =
    match way known v, onward successors is_end v with Some way, Some rest -> Some (way @ rest) | _, _ -> None in
  Option.map (fun (least, v) -> { least; way = whole v }) (List.fold_left lower None order)

let of_vehicle system (vehicle : Scenario.vehicle) =
  match Timed_system.edges system, Timed_system.stuck system, Timed_system.course system with
  | Some edges, None, Some course when vehicle.id = Course.vehicle course ->
    let looks = Course.is_heard course && not (List.exists binds_again edges) in
    let stays = Array.init (Timed_system.count system) (fun n -> Option.get (Timed_system.stay system n)) in
    let ends = List.map fst (Timed_system.ends system) in
    of_graph { vehicle; looks; stays; fastest = fastest vehicle stays } ~is_end:(fun n -> List.mem n ends) edges
  | _, _, _ -> None
