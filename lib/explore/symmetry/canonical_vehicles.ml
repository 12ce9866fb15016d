open Dolphin_semantics
open Dolphin_environment

type t = {
  options : Environment.options;
  program : Core.program;
  world : World.t;
  assumed : Symmetry.t;
  liveness : Liveness.t;
  plans : (string, unit) Hashtbl.t;  (* whose endings are the same within each orbit *)
  prompts : (string, unit) Hashtbl.t;  (* whose answers name no vehicle *)
  mutable used : bool;
}

let create options program ~asked world assumed =
  {
    options;
    program;
    world;
    assumed;
    liveness = Liveness.of_program program ~asked:(List.map Condition.closure asked);
    plans = Hashtbl.create 16;
    prompts = Hashtbl.create 16;
    used = false;
  }

let is_used r = r.used
let set_used r = r.used <- true
let orbit r v = Vehicle_orbits.of_vehicle r.assumed.vehicles v
let all_of_orbit r v = Array.to_list (orbit r v)
let is_movable r v = Array.length (orbit r v) > 0

(* {1 Broken symmetry} *)

let broken r vehicles = raise (Symmetry.Broken { r.assumed with vehicles })
let split r f = broken r (Vehicle_orbits.split f r.assumed.vehicles)
let fix r vs = split r (fun v -> if List.mem v vs then Some v else None)
let fix_all r = broken r Vehicle_orbits.none

(* {1 Canonical forms} *)

let named r x =
  let found = ref [] in
  let look v =
    if is_movable r v then found := v :: !found;
    v
  in
  ignore (Renaming.value look x);
  !found

let names_vehicles r x = named r x <> []

let forget r c = Liveness.forget r.liveness (names_vehicles r) c

(* [c] and [outside] with each vehicle [v] as [f v]. [f] meets the vehicles in an order that does not depend on their
   names; after [unordered ()] in one that does. *)
let renamed r f ~unordered (c : Configuration.t) outside =
  let bound = List.map f c.shared.bound in
  let control = Renaming.control f c.control in
  let set store (i, x) = Store.set i (Renaming.value f x) store in
  let store = List.fold_left set Store.empty (Store.bindings c.shared.store) in
  let put v p allocation = Vehicle_map.add (f v) p allocation in
  let allocation = Vehicle_map.fold put c.shared.allocation Vehicle_map.empty in
  let tuples () = Renaming.tuples r.program f ~unordered c.shared.tuples in
  (* Lost vehicles that are named nowhere else can be exchanged. *)
  let outside () = Environment.renamed f outside in
  let tuples, outside =
    (* Of an end only what it breaks matters, and not which vehicles N names. *)
    if Configuration.has_ended c then
      let outside = outside () in
      (tuples (), outside)
    else
      let tuples = tuples () in
      (tuples, outside ())
  in
  ({ Configuration.control; shared = { store; allocation; bound; tuples } }, outside)

(* For each unnamed vehicle, the pairs of N with unordered keys that contain it: with the new names of other
   vehicles, and without its own. Two such vehicles in one pair break the symmetry. *)
let sayings r name (c : Configuration.t) =
  let said = Hashtbl.create 8 in
  let add k x =
    let found = ref Vehicle_set.empty in
    let look v = if name v = None then found := Vehicle_set.add v !found; v in
    ignore (Renaming.value look x);
    match Vehicle_set.elements !found with
    | [] -> ()
    | [ v ] ->
      let x = Value.normal (Renaming.value (fun u -> Option.value (name u) ~default:"") x) in
      Hashtbl.replace said v ((k, x) :: Option.value (Hashtbl.find_opt said v) ~default:[])
    | vs -> fix r (List.concat_map (all_of_orbit r) vs)
  in
  let add_all (k, xs) = if not (Tuples.is_ordered k c.shared.tuples) then List.iter (add k) xs in
  List.iter add_all (Tuples.bindings c.shared.tuples);
  said

(* The vehicles that occur only in such pairs, sorted by them: an order that does not depend on names. Vehicles with
   equal pairs can be exchanged. *)
let named_by_pairs r name c outside =
  let compare_pair (k, x) (k', x') = match String.compare k k' with 0 -> Value.compare x x' | order -> order in
  let compare (_, remembered, pairs) (_, remembered', pairs') =
    match Stdlib.compare (remembered : bool * bool) remembered' with
    | 0 -> List.compare compare_pair pairs pairs'
    | order -> order
  in
  let remembered v = (List.mem v (Environment.lost outside), List.mem v (Environment.late outside)) in
  let add v pairs found = (v, remembered v, List.sort compare_pair pairs) :: found in
  List.map (fun (v, _, _) -> v) (List.sort compare (Hashtbl.fold add (sayings r name c) []))

let canonical r c outside =
  let naming = Vehicle_orbits.naming r.assumed.vehicles in
  let name = Vehicle_orbits.name naming in
  match
    let c = forget r c in
    let unordered () =
      if not (Configuration.has_ended c) then
        List.iter (fun v -> ignore (name v)) (named_by_pairs r (Vehicle_orbits.name_of naming) c outside)
    in
    let form = renamed r name ~unordered c outside in
    if Vehicle_orbits.is_identity naming then (c, outside) else form
  with
  | exception Renaming.Too_large -> fix_all r
  | (c', _) as form ->
    if not (r.used || Configuration.equal c c') then r.used <- true;
    form

(* {1 Transitions} *)

let vehicles_of r c outside =
  let found = ref Vehicle_set.empty in
  let look v = found := Vehicle_set.add v !found; v in
  ignore (renamed r look ~unordered:ignore (forget r c) outside);
  !found

(* The first vehicle of the orbit of [v]. *)
let first r v = match orbit r v with [||] -> v | orbit -> orbit.(0)

(* Some vehicles by orbit, in the order of the first of each. *)
let by_orbit r vs =
  let first = first r in
  let add found v =
    let before = Option.value (List.assoc_opt (first v) found) ~default:[] in
    (first v, v :: before) :: List.remove_assoc (first v) found
  in
  List.map (fun (_, vs) -> List.rev vs) (List.fold_left add [] vs)

(* Several vehicles are bound in the order of the world. If there are others between those of an orbit, only vehicles
   without others between them can be exchanged. *)
let check_order r accepted =
  let number (run, before, runs) v =
    let run = match before with Some u when String.equal u (first r v) -> run | Some _ | None -> run + 1 in
    (run, Some (first r v), (v, run) :: runs)
  in
  let last, _, runs = List.fold_left number (0, None, []) accepted in
  if last > List.length (by_orbit r accepted) then split r (fun v -> List.assoc_opt v runs)

(* An exchangeable id is not a text of the program: it was computed. *)
let check_id r (asked : Vehicle_filter.t) = Option.iter (fun id -> if is_movable r id then fix r [ id ]) asked.id

let picking r outside (c : Configuration.t) (pick : Settings.pick) =
  check_id r pick.filter;
  (* If the program looks at a region, the vehicles of an orbit stand at one place. *)
  let is_accepted = Settings.accepts { pick.filter with region = None } in
  let id (s : World.vehicle_state) = s.id in
  let accepted = List.map id (List.filter is_accepted (World.vehicles r.world)) in
  let is_known =
    match vehicles_of r c outside with
    | known -> fun v -> Vehicle_set.mem v known
    | exception Renaming.Too_large -> fix_all r
  in
  let bound = Vehicle_set.of_list c.shared.bound in
  let free = List.filter (fun v -> not (Vehicle_set.mem v bound)) accepted in
  if pick.count <> Exactly 1 then begin
    check_order r accepted;
    let check = function
      | v :: _ :: _ as vs when is_movable r v && List.exists is_known vs -> fix r (all_of_orbit r v)
      | _ -> ()
    in
    List.iter check (by_orbit r free)
  end;
  let alike v = if is_movable r v && not (is_known v) then Some (first r v) else None in
  let exchanged vs =
    let others = List.filter (fun v -> alike v <> None) vs in
    match pick.count, r.options.faults.join with
    | (Exactly _ | All), Any_number -> List.compare_length_with others 1 > 0
    | Exactly n, (Never | At_most _) -> List.compare_length_with others n > 0
    | All, (Never | At_most _) -> false
  in
  if List.exists exchanged (by_orbit r free) then r.used <- true;
  alike

(* {2 Recruits} *)

let known r c outside =
  match vehicles_of r c outside with
  | found -> List.filter (is_movable r) (Vehicle_set.elements found)
  | exception Renaming.Too_large -> fix_all r

let known_in_task r t =
  let found = ref Vehicle_set.empty in
  let look v = if is_movable r v then found := Vehicle_set.add v !found; v in
  match Renaming.residual look t with
  | (_ : Residual.t) -> Vehicle_set.elements !found
  | exception Renaming.Too_large -> fix_all r

(* Vehicles of an orbit that no part of the state mentions all fit if one of them does: the task or the bindings
   mention the others. *)
let follows_recruit r (asked : Vehicle_filter.t) ~turn ~is_known v =
  check_id r asked;
  let orbit = orbit r v in
  let n = Array.length orbit in
  let rec first i = if is_known orbit.((turn + i) mod n) then first (i + 1) else orbit.((turn + i) mod n) in
  let follows = n = 0 || is_known v || String.equal v (first 0) in
  if not follows then r.used <- true;
  follows

(* {2 The outside} *)

(* Answers are code from outside of the program: they must read no variable. *)
let check_answers r prompt =
  if not (Hashtbl.mem r.prompts prompt) then begin
    let is_harmless text =
      match Elaborate.answer r.program text with
      | Ok closure -> Name_flow.computes closure.lambda.code
      | Error _ -> true
    in
    if not (List.for_all is_harmless (List.concat (r.options.answers prompt))) then fix_all r;
    Hashtbl.add r.prompts prompt ()
  end

(* A supplier names vehicles of the fleet. *)
let check_replies r call =
  let names = function Ok x -> named r x | Error _ -> [] in
  match List.concat_map names (List.concat (r.options.replies call)) with [] -> () | vs -> fix r vs

let check_plan r name =
  if not (Hashtbl.mem r.plans name) then begin
    let ending v = Environment.ending r.options v name in
    let as_first (s : World.vehicle_state) =
      ending s.id = ending (first r s.id)
    in
    if not (List.for_all as_first (World.vehicles r.world)) then split r ending;
    Hashtbl.add r.plans name ()
  end

(* Any plan may be in a task that is not made yet: those that the options name, and one of all others. *)
let check_all_plans r =
  let plans = r.options.plans in
  List.iter (check_plan r) (String.concat "" ("other" :: plans) :: plans)

let check_plans r =
  Residual.fold_leaves (fun () -> function
      | Plan (p, _) -> check_plan r p.name
      | Maker _ | Term _ -> check_all_plans r
      | Code _ | Handler _ | Given _ | Held _ | Timer _ -> ()) ()

let choices r outside (c : Configuration.t) =
  let alike =
    match c.control with
    | Waiting (_, Pick pick) -> Some (picking r outside c pick)
    | Waiting (_, Ask prompt) -> check_answers r prompt; None
    | Waiting (_, Host_call { subject; member; _ }) ->
      check_replies r (Machine.name_of_call ~subject ~member);
      None
    | Script _ | Waiting (_, (Pause _ | Execute _)) | Executing _ | Ended _ -> None
  in
  let check ((t : Transition.t), _ as choice) =
    (match c.control, t.next.control with
     | Script _, Executing (_, r') -> check_plans r r'
     | _, _ -> ());
    choice
  in
  Seq.map check (Environment.choices ?alike r.options r.program r.world outside c)
