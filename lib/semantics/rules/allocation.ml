open Dolphin_plans
open Dolphin_results
open Core
module Assignment = Dolphin_assignment.Assignment

type leaf = { task : platform_task; allowed : vehicle list option  (* by the [T[V]] around it; [None]: all *) }

let restrict allowed vs =
  match allowed with
  | None -> Some vs
  | Some ws -> Some (List.filter (fun v -> List.mem v ws) vs)

(* [next_opened ()] is the keys and the task of the next [fresh]: parts are walked from left to right. *)
let rec tree_of next_opened allowed t : leaf Assignment.tree =
  let of_task = tree_of next_opened allowed in
  let both a b =
    let a = of_task a in
    [ a; of_task b ]
  in
  match t with
  | Platform task -> Leaf { task; allowed }
  | Action _ | Condition _ | Idle _ | Confirm _ | Made _ | Recruit _ -> Shared []
  | Sequence (a, b) -> Shared (both a b)
  | Parallel (a, b) -> Disjoint (both a b)
  | Allocated (a, vs) -> tree_of next_opened (restrict allowed vs) a
  | All_of branches | One_of branches -> Shared (List.map (fun (b : Core.branch) -> of_task b.body) branches)
  | Until (_, _, a) | During (_, _, a) | Watch (a, _) | Repeat { body = a; _ } -> of_task a
  | Ensure (_, a) -> of_task a
  | Fresh _ -> of_task (snd (next_opened ()))

let rec map_tree f : 'a Assignment.tree -> ('b Assignment.tree, 'e) result = function
  | Leaf x -> Result.map (fun y -> Assignment.Leaf y) (f x)
  | Disjoint trees -> Result.map (fun trees -> Assignment.Disjoint trees) (Results.map (map_tree f) trees)
  | Shared trees -> Result.map (fun trees -> Assignment.Shared trees) (Results.map (map_tree f) trees)

let rec leaves tree rest =
  match (tree : 'a Assignment.tree) with
  | Leaf x -> x :: rest
  | Disjoint trees | Shared trees -> List.fold_right leaves trees rest

(* The devices that a vehicle, with [state] in the world, lacks for a task, or nothing. The plan's needs are looked
   up once for all vehicles. *)
let lack task =
  let requires = Option.map (fun plan -> (plan, Inline_plan.required_payload plan)) task.plan in
  fun v state ->
    match state, requires with
    | None, _ -> Some "nothing is known of it"
    | Some _, None -> None
    | Some state, Some (plan, devices) ->
      let vehicles = Inline_plan.vehicles plan in
      if vehicles <> [] && not (List.mem v vehicles) then Some "the plan is for other vehicles"
      else if World.carries devices state then None
      else
        let missing = List.filter (fun d -> not (World.carries [ d ] state)) devices in
        Some ("it lacks " ^ String.concat ", " missing)

module Wgs84 = Dolphin_geo.Wgs84

(* A vehicle of B, with its state in the world. *)
type candidate = {
  vehicle : vehicle;
  state : World.vehicle_state option;
  place : (Wgs84.cartesian option, World.question) result Lazy.t;
}

let candidate_of world vehicle =
  let state = World.find vehicle world in
  let place s = Result.map (fun p -> Some (Wgs84.cartesian p)) (World.place world s) in
  { vehicle; state; place = lazy (Option.fold ~none:(Ok None) ~some:place state) }

(* [once f] is [f], computed once for each key, which are few and known by identity. *)
let once f =
  let known = ref [] in
  fun key ->
    match List.assq_opt key !known with
    | Some x -> x
    | None ->
      let x = f key in
      known := (key, x) :: !known;
      x

(* [sharing ()] gives of equal neighbours the first: the vehicles of thousands of plans are the same as a rule. *)
let sharing () =
  let latest = ref [||] in
  fun places ->
    let is_latest = Array.length places = Array.length !latest && Array.for_all2 Int.equal places !latest in
    if not is_latest then latest := places;
    !latest

(* Those of [places] with [keep]: the array itself if it keeps all. *)
let filtered keep places =
  if Array.for_all keep places then places else Array.of_list (List.filter keep (Array.to_list places))

(* The first question about the place of a vehicle of [places]. *)
let first_question all places =
  let question i = match Lazy.force all.(i).place with Ok _ -> None | Error question -> Some question in
  Seq.filter_map question (Array.to_seq places) ()

(* The distance from the place of each vehicle of [all]. *)
let metres_to reference all =
  let reference = Wgs84.cartesian reference in
  fun i ->
    match Lazy.force all.(i).place with
    | Ok (Some place) -> Wgs84.straight place reference
    | Ok None | Error _ -> 0.

(* So few vehicles are found one by one. *)
let few = 8

(* The leaves of assignment. What depends on the [T[V]] around a task is computed once, and so is the leaf of all tasks
   by name under it. *)
let candidates_once world bound =
  let all = Array.map (candidate_of world) bound in
  let everywhere = Array.init (Array.length bound) Fun.id and shared = sharing () in
  let place_of = Hashtbl.create (Array.length bound) in
  Array.iteri (fun i v -> Hashtbl.replace place_of v i) bound;
  let are_all_known = lazy (Array.for_all (fun c -> Result.is_ok (Lazy.force c.place)) all) in
  let among places leaf : (Assignment.leaf, World.question) result =
    let lack = lack leaf.task in
    let vehicles = shared (filtered (fun i -> Option.is_none (lack all.(i).vehicle all.(i).state)) places) in
    match Option.bind leaf.task.plan Inline_plan.reference with
    | None -> Ok { vehicles; metres = None }
    | Some reference -> (
        match if Lazy.force are_all_known then Seq.Nil else first_question all vehicles with
        | Cons (question, _) -> Error question
        | Nil -> Ok { vehicles; metres = Some (metres_to reference all) })
  in
  let places_of = function
    | None -> everywhere
    | Some vs ->
      shared (Array.of_list (List.sort_uniq Int.compare (List.filter_map (Hashtbl.find_opt place_of) vs)))
  in
  let places_once = once places_of and by_name = ref [] in
  fun leaf ->
    match leaf.allowed, leaf.task.plan with
    | Some vs, _ when List.compare_length_with vs few <= 0 -> among (places_of leaf.allowed) leaf
    | (Some _ | None), Some _ -> among (places_once leaf.allowed) leaf
    | (Some _ | None), None -> (
        match List.assq_opt leaf.allowed !by_name with
        | Some known -> known
        | None ->
          let candidates = among (places_once leaf.allowed) leaf in
          by_name := (leaf.allowed, candidates) :: !by_name;
          candidates)

let names vs = String.concat ", " vs

module String_set = Set.Make (String)

let permitted leaf =
  match leaf.allowed with
  | None -> fun _ -> true
  | Some vs ->
    let set = String_set.of_list vs in
    fun v -> String_set.mem v set

let no_candidate world bound leaf =
  let permitted = permitted leaf in
  let some = List.filter permitted (Array.to_list bound) in
  let reason =
    match leaf.allowed, some with
    | _, [] when bound = [||] -> "no vehicle is bound to the program: pick one first"
    | Some [], _ -> "the vehicle set given to it is empty"
    | Some vs, [] -> Printf.sprintf "none of the vehicles given to it is bound to the program: %s" (names vs)
    | None, [] -> "no vehicle is eligible for it"
    | _, _ ->
      let why v = Option.map (Printf.sprintf "%s: %s" v) (lack leaf.task v (World.find v world)) in
      String.concat "; " (List.filter_map why some)
  in
  Fault.make leaf.task.task_site (Printf.sprintf "no vehicle can run task '%s': %s" leaf.task.name reason)

let conflict bound leaves competing vehicles =
  let competing = List.map (fun i -> leaves.(i)) competing in
  let first = match competing with leaf :: _ -> leaf.task.task_site | [] -> Fault.unknown_site in
  Fault.make first
    (Printf.sprintf "tasks %s run side by side and need different vehicles, but there is only %s"
       (String.concat ", " (List.map (fun leaf -> Printf.sprintf "'%s'" leaf.task.name) competing))
       (names (List.map (fun i -> bound.(i)) vehicles)))

(* The vehicles of the parts of a task, from left to right. *)
type supply = {
  next_vehicle : unit -> vehicle;
  next_timer : unit -> Residual.timer;
  next_place : unit -> Residual.timer;  (* of code that makes a task *)
  next_opened : unit -> Residual.timer list * task;  (* the keys and the task of the next [fresh] *)
  depth : int;  (* of such code *)
}

(* [beside t ts] is the branches of [t | T1 | ... | Tn], flat: a task made in a loop is as deep as it has branches. *)
let beside t ts =
  let rec add t rest = match t with Parallel (a, b) -> add a (add b rest) | t -> t :: rest in
  add t (List.fold_right add ts [])

(* The task with the vehicles of [supply]; [allowed] is by the [T[V]] around it. *)
let rec residual supply allowed t : Residual.t =
  let recurse = residual supply allowed in
  match t with
  | Platform p -> Ready (p, supply.next_vehicle ())
  | Made code ->
    let place = supply.next_place () in
    Made { code; given = []; request = { allowed; place; depth = supply.depth } }
  | Recruit { asked; code; site } ->
    let number = supply.next_timer () in
    Recruit { number; asked; code; place = supply.next_place (); depth = supply.depth; site }
  | Action c -> Action c
  | Condition c -> Condition c
  | Sequence (a, b) ->
    let a = recurse a in
    Residual.sequence a (recurse b)
  | Parallel (a, b) -> Residual.parallel (List.map recurse (beside a [ b ]))
  | Allocated (a, vs) -> residual supply (restrict allowed vs) a
  | All_of branches -> Residual.all_of None (List.map (branch supply allowed) branches)
  | One_of branches -> One_of (List.map (branch supply allowed) branches)
  | Until (on_cut, c, a) -> Until (on_cut, c, recurse a)
  | Idle { seconds; site } -> Idle { timer = supply.next_timer (); seconds; site }
  | Confirm { prompt; site } -> Confirm { question = supply.next_timer (); prompt; site }
  | During (on_cut, duration, a) ->
    let timer = supply.next_timer () in
    During { on_cut; timer; duration; started = false; body = recurse a }
  | Watch (a, code) when Recovery.possible code.lambda ->
    let place = supply.next_place () in
    Watch (recurse a, { code; anew = Some (a, { allowed; place; depth = supply.depth }) })
  | Watch (a, code) -> Watch (recurse a, { code; anew = None })
  | Fresh _ ->
    let ns, a = supply.next_opened () in
    Fresh (ns, recurse a)
  | Ensure (ds, a) -> Residual.ensuring ds (recurse a)
  | Repeat { rounds; until; body; site } ->
    let each = recurse body in
    Residual.repeat { left = Option.map pred rounds; until; each; site } each

and branch supply allowed (b : Core.branch) : Residual.branch =
  { guard = b.guard; body = residual supply allowed b.body }

let most_parts = 1_000_000
let deepest = 10_000

(* A loop that doubles a task makes one that no memory could hold: such tasks, and too deep ones, are not walked. *)
let is_too_large t =
  (* [count] parts before those in the list, each with its depth. *)
  let rec from count = function
    | [] -> false
    | (depth, t) :: rest ->
      if count >= most_parts || depth > deepest then true
      else
        let down ts = from (count + 1) (List.rev_append (List.rev_map (fun t -> (depth + 1, t)) ts) rest) in
        down (Task.parts t)
  in
  from 0 [ (0, t) ]

(* The code of each [fresh] in [t], from left to right; the other tasks that it gives are not seen. *)
let fresh t =
  let rec add t rest = match t with Fresh code -> code :: rest | t -> List.fold_right add (Task.parts t) rest in
  if is_too_large t then [] else add t []

type opened = { tasks : (Residual.timer list * task) list; numbers : Residual.timer Seq.t }

(* [one_by_one xs] gives the elements of [xs], one in each call. *)
let one_by_one xs =
  let left = ref xs in
  fun () ->
    match !left () with
    | Seq.Nil -> invalid_arg "Allocation: too few numbers, or tasks"
    | Seq.Cons (x, rest) ->
      left := rest;
      x

let too_large =
  Printf.sprintf "the task has more than %d parts, or is nested more than %d deep" most_parts deepest

(* [supply next_vehicle] gives what else the parts get. The vehicles are those that are used, in pick order. *)
let allocate_small world bound ~allowed ~supply opened t =
  let bound = Array.of_list bound in
  let tree = tree_of (one_by_one (List.to_seq opened.tasks)) allowed t in
  let tasks = Array.of_list (leaves tree []) in
  let solved candidates =
    match Assignment.solve ~vehicles:(Array.length bound) candidates with
    | Ok vehicles ->
      let used = List.sort_uniq Int.compare (Array.to_list vehicles) in
      let next_vehicle = one_by_one (Seq.map (Array.get bound) (Array.to_seq vehicles)) in
      let supply = supply next_vehicle (one_by_one (List.to_seq opened.tasks)) in
      Ok (List.map (Array.get bound) used, residual supply allowed t)
    | Error (No_candidate i) -> Error (no_candidate world bound tasks.(i))
    | Error (Conflict { leaves; vehicles }) -> Error (conflict bound tasks leaves vehicles)
  in
  Result.map solved (map_tree (candidates_once world bound) tree)

let allocate_with world bound ~allowed ~supply opened t =
  if is_too_large t then Ok (Error (Fault.make Fault.unknown_site too_large))
  else allocate_small world bound ~allowed ~supply opened t

let allocate world bound opened t =
  let next = one_by_one opened.numbers in
  let supply next_vehicle next_opened =
    { next_vehicle; next_timer = next; next_place = next; next_opened; depth = 0 }
  in
  Result.map (Result.map snd) (allocate_with world bound ~allowed:None ~supply opened t)

let allocate_made world bound opened (request : Residual.request) t =
  let next_timer = one_by_one opened.numbers in
  let supply next_vehicle next_opened =
    { next_vehicle; next_timer; next_place = (fun () -> request.place); next_opened; depth = request.depth }
  in
  allocate_with world bound ~allowed:request.allowed ~supply opened t
