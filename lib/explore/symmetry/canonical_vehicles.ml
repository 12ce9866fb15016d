open Dolphin_semantics
open Dolphin_environment
module Vehicles = Set.Make (String)

exception Told_apart of Vehicle_orbits.t

type t = {
  options : Environment.options;
  program : Core.program;
  world : World.t;
  peers : Vehicle_orbits.t;
  liveness : Liveness.t;
  plans : (string, unit) Hashtbl.t;  (* whose endings are the same for peers *)
  prompts : (string, unit) Hashtbl.t;  (* to which answers are harmless *)
  mutable used : bool;
}

let create options program ~asked world peers =
  {
    options;
    program;
    world;
    peers;
    liveness = Liveness.of_program program ~asked:(List.map Condition.closure asked);
    plans = Hashtbl.create 16;
    prompts = Hashtbl.create 16;
    used = false;
  }

let is_used r = r.used
let all_peers r v = Array.to_list (Vehicle_orbits.of_vehicle r.peers v)
let has_peers r v = all_peers r v <> []

(* {1 What turns out} *)

let split r f = raise (Told_apart (Vehicle_orbits.split f r.peers))
let alone r vs = split r (fun v -> if List.mem v vs then Some v else None)
let nobody () = raise (Told_apart Vehicle_orbits.none)

(* {1 Canonical forms} *)

let named r x =
  let found = ref [] in
  let look v =
    if has_peers r v then found := v :: !found;
    v
  in
  ignore (Renaming.value look x);
  !found

let names_vehicles r x = named r x <> []

let forget r c = Liveness.forget r.liveness (names_vehicles r) c

(* [c] and [outside] with [f] of each vehicle: first in an order in which names play no part; after [in_no_order ()], in
   one in which they do. *)
let renamed r f ~in_no_order (c : Configuration.t) outside =
  let bound = List.map f c.bound in
  let control = Renaming.control f c.control in
  let set store (i, x) = Store.set i (Renaming.value f x) store in
  let store = List.fold_left set Store.empty (Store.bindings c.store) in
  let tuples = Renaming.tuples r.program f ~in_no_order c.tuples in
  let put v p allocation = Configuration.Vehicle_map.add (f v) p allocation in
  let allocation = Configuration.Vehicle_map.fold put c.allocation Configuration.Vehicle_map.empty in
  (* Whose connection was lost and who is named nowhere else is like others of that kind. *)
  let outside = Environment.renamed f outside in
  ({ Configuration.control; store; allocation; bound; tuples }, outside)

(* The vehicles that only pairs of N name whose order is not kept, in an order in which names play no part: by what
   would be said of each if others had their new names, [name v], and it none. Those of which the same is said are
   alike. *)
let posted r name (c : Configuration.t) outside =
  let said = Hashtbl.create 8 in
  let add k x =
    let found = ref Vehicles.empty in
    let look v = if name v = None then found := Vehicles.add v !found; v in
    ignore (Renaming.value look x);
    match Vehicles.elements !found with
    | [] -> ()
    | [ v ] ->
      let x = Renaming.value (fun u -> Option.value (name u) ~default:"") x in
      Hashtbl.replace said v ((k, x) :: Option.value (Hashtbl.find_opt said v) ~default:[])
    | vs -> alone r (List.concat_map (all_peers r) vs)
  in
  let add_all (k, xs) = if not (Tuples.is_ordered k c.tuples) then List.iter (add k) xs in
  List.iter add_all (Tuples.bindings c.tuples);
  let compare_pair (k, x) (k', x') = match String.compare k k' with 0 -> Value.compare x x' | order -> order in
  let compare (_, lost, pairs) (_, lost', pairs') =
    match Bool.compare lost lost' with 0 -> List.compare compare_pair pairs pairs' | order -> order
  in
  let all v pairs found = (v, List.mem v (Environment.lost outside), List.sort compare_pair pairs) :: found in
  List.map (fun (v, _, _) -> v) (List.sort compare (Hashtbl.fold all said []))

let is_end (c : Configuration.t) =
  match c.control with Ended _ -> true | Script _ | Waiting _ | Executing _ -> false

let canonical r c outside =
  let names = Hashtbl.create 16 and taken = Hashtbl.create 16 in
  let rename v =
    match Vehicle_orbits.of_vehicle r.peers v, Hashtbl.find_opt names v with
    | [||], _ -> v
    | _, Some name -> name
    | peers, None ->
      let next = Option.value (Hashtbl.find_opt taken peers.(0)) ~default:0 in
      Hashtbl.replace taken peers.(0) (next + 1);
      Hashtbl.add names v peers.(next);
      peers.(next)
  in
  let known v = if has_peers r v then Hashtbl.find_opt names v else Some v in
  match
    let shorter = forget r c in
    (* Of an end, only what it breaks matters. *)
    let posted () = if is_end c then [] else posted r known shorter outside in
    let in_no_order () = List.iter (fun v -> ignore (rename v)) (posted ()) in
    let named, outside' = renamed r rename ~in_no_order shorter outside in
    if Hashtbl.fold (fun v name same -> same && String.equal v name) names true then (shorter, outside)
    else (named, outside')
  with
  | exception Renaming.Too_large -> nobody ()
  | (c', _) as form ->
    if not (r.used || Configuration.equal c c') then r.used <- true;
    form

(* {1 Transitions} *)

let vehicles_of r c outside =
  let found = ref Vehicles.empty in
  let look v = found := Vehicles.add v !found; v in
  ignore (renamed r look ~in_no_order:ignore (forget r c) outside);
  !found

(* The classes that some vehicles are of, in the order of their first ones, each with its vehicles; those that have no
   peers are classes too. *)
let classes r vs =
  let first v = match Vehicle_orbits.of_vehicle r.peers v with [||] -> v | peers -> peers.(0) in
  let add found v =
    let before = Option.value (List.assoc_opt (first v) found) ~default:[] in
    (first v, v :: before) :: List.remove_assoc (first v) found
  in
  List.map (fun (_, vs) -> List.rev vs) (List.fold_left add [] vs)

(* Several are bound in the order in which they were first heard of. Of peers with others between them, the first ones
   come before those others, and the last ones after. *)
let check_order r accepted =
  let first v = match Vehicle_orbits.of_vehicle r.peers v with [||] -> v | peers -> peers.(0) in
  let number (run, before, runs) v =
    let run = match before with Some u when String.equal u (first v) -> run | Some _ | None -> run + 1 in
    (run, Some (first v), (v, run) :: runs)
  in
  let last, _, runs = List.fold_left number (0, None, []) accepted in
  if last > List.length (classes r accepted) then split r (fun v -> List.assoc_opt v runs)

let picking r outside (c : Configuration.t) (pick : Settings.pick) =
  Option.iter (fun id -> if has_peers r id then alone r [ id ]) pick.filter.id;
  (* Peers are in the same regions, if any is looked at. *)
  let is_accepted = Settings.accepts { pick.filter with region = None } in
  let id (s : World.vehicle_state) = s.id in
  let accepted = List.map id (List.filter is_accepted (World.vehicles r.world)) in
  let is_known =
    match vehicles_of r c outside with
    | known -> fun v -> Vehicles.mem v known
    | exception Renaming.Too_large -> nobody ()
  in
  let free = List.filter (fun v -> not (List.mem v c.bound)) accepted in
  if pick.count <> Exactly 1 then begin
    check_order r accepted;
    let check = function
      | v :: _ :: _ as vs when has_peers r v && List.exists is_known vs -> alone r (all_peers r v)
      | _ -> ()
    in
    List.iter check (classes r free)
  end;
  match pick.count with
  | All -> r.world
  | Exactly n ->
    let rest vs = List.filteri (fun i _ -> i >= n) (List.filter (fun v -> has_peers r v && not (is_known v)) vs) in
    let hidden = List.concat_map rest (classes r free) in
    if hidden <> [] then r.used <- true;
    World.suppose (List.map (fun v -> World.Missing v) hidden) r.world

(* Answers are code that this knows nothing of, but that it may not read any variable. *)
let check_answers r prompt =
  if not (Hashtbl.mem r.prompts prompt) then begin
    let is_harmless text =
      match Elaborate.answer r.program text with
      | Ok closure -> Name_flow.computes closure.lambda.code
      | Error _ -> true
    in
    if not (List.for_all is_harmless (List.concat (r.options.answers prompt))) then nobody ();
    Hashtbl.add r.prompts prompt ()
  end

(* Whoever a supplier names is known by name. *)
let check_replies r call =
  let names = function Ok x -> named r x | Error _ -> [] in
  match List.concat_map names (List.concat (r.options.replies call)) with [] -> () | vs -> alone r vs

let check_plan r (p : Core.platform_task) =
  if not (Hashtbl.mem r.plans p.name) then begin
    let ending v = r.options.endings v p.name in
    let as_first (s : World.vehicle_state) =
      match Vehicle_orbits.of_vehicle r.peers s.id with [||] -> true | peers -> ending s.id = ending peers.(0)
    in
    if not (List.for_all as_first (World.vehicles r.world)) then split r ending;
    Hashtbl.add r.plans p.name ()
  end

let rec check_plans r (t : Residual.t) =
  let branches = List.iter (fun (b : Residual.branch) -> check_plans r b.body) in
  match t with
  | Ready (p, _) | Running (p, _) -> check_plan r p
  | Action _ | Condition _ | Idle _ -> ()
  | Sequence (a, rest) -> List.iter (check_plans r) (a :: rest)
  | Parallel rs -> List.iter (check_plans r) rs
  | All_of (a, bs) -> Option.iter (check_plans r) a; branches bs
  | One_of bs -> branches bs
  | Until (_, a) | During { body = a; _ } | Watch (a, _) -> check_plans r a

let choices r outside (c : Configuration.t) =
  let world =
    match c.control with
    | Waiting (_, Pick pick) -> picking r outside c pick
    | Waiting (_, Ask prompt) -> check_answers r prompt; r.world
    | Waiting (_, Host_call { subject; member; _ }) ->
      check_replies r (Machine.name_of_call ~subject ~member);
      r.world
    | Script _ | Waiting (_, (Pause _ | Execute _)) | Executing _ | Ended _ -> r.world
  in
  let found = Environment.choices r.options r.program world outside c in
  let check ((t : Transition.t), _) =
    match c.control, t.next.control with
    | Script _, Executing (_, r') -> check_plans r r'
    | _, _ -> ()
  in
  List.iter check found;
  found
