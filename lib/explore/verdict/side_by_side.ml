open Dolphin_plans
open Dolphin_semantics

type nearness = Near of Fences.near | Unknown

type pair = {
  one : Core.vehicle * Core.platform_task;
  other : Core.vehicle * Core.platform_task;
  nearness : nearness;
}

let name (p : Core.platform_task) = "'" ^ p.name ^ "'"

(* [places]: all that may be known of the way of a plan, wherever its vehicle is; [[]]: not known. *)
type plan = { number : int; task : Core.platform_task; places : Plan_room.part list }

type t = {
  fences : Fences.t;
  plans : (Core.site * string * Inline_plan.t option, plan) Hashtbl.t;
  nearness : (int * int, nearness option) Hashtbl.t;
  seen : (int * int, pair option) Hashtbl.t;
  mutable interesting : int;  (* of [seen] *)
  mutable near : bool;
}

let create fences =
  { fences; plans = Hashtbl.create 16; nearness = Hashtbl.create 64; seen = Hashtbl.create 64; interesting = 0;
    near = false }


let plan t (task : Core.platform_task) =
  let key = (task.task_site, task.name, task.plan) in
  match Hashtbl.find_opt t.plans key with
  | Some plan -> plan
  | None ->
    let places = Option.fold task.plan ~none:[] ~some:(Plan_room.make ~from:None) in
    let plan = { number = Hashtbl.length t.plans; task; places } in
    Hashtbl.add t.plans key plan;
    plan

let nearness t p q =
  let key = (p.number, q.number) in
  match Hashtbl.find_opt t.nearness key with
  | Some known -> known
  | None ->
    let found =
      match p.places, q.places with
      | [], _ | _, [] -> Some Unknown
      | ps, qs -> Option.map (fun near -> Near near) (Fences.near t.fences ps qs)
    in
    Hashtbl.add t.nearness key found;
    found

(* By sites. *)
let in_order p q = if (p.task.task_site, p.number) <= (q.task.task_site, q.number) then (p, q) else (q, p)

let see_pair t (v, p) (w, q) =
  let (v, p), (w, q) = if fst (in_order p q) == p then ((v, p), (w, q)) else ((w, q), (v, p)) in
  let key = (p.number, q.number) in
  if not (Hashtbl.mem t.seen key) then begin
    let pair nearness = { one = (v, p.task); other = (w, q.task); nearness } in
    let found = Option.map pair (nearness t p q) in
    (match found with
     | Some { nearness = Near _; _ } -> t.near <- true
     | Some { nearness = Unknown; _ } | None -> ());
    if found <> None then t.interesting <- t.interesting + 1;
    Hashtbl.add t.seen key found
  end

let see t allocation =
  let running = List.map (fun (v, task) -> (v, plan t task)) (Vehicle_map.bindings allocation) in
  let rec each = function
    | [] -> ()
    | one :: others -> List.iter (see_pair t one) others; each others
  in
  each running

let pairs t =
  let add key pair pairs = match pair with Some p -> (key, p) :: pairs | None -> pairs in
  let found = Hashtbl.fold add t.seen [] in
  let place (key, { one = _, p; other = _, q; nearness }) = (nearness = Unknown, p.task_site, q.task_site, key) in
  List.map snd (List.sort (fun a b -> compare (place a) (place b)) found)

let first_near t = t.near

(* {1 Candidates} *)

let candidates t =
  let plans = Hashtbl.fold (fun _ plan plans -> plan :: plans) t.plans [] in
  let is_one p q = p.number <= q.number && (let p, q = in_order p q in nearness t p q <> None) in
  List.fold_left (fun n p -> n + List.length (List.filter (is_one p) plans)) 0 plans

let seen_all ~candidates t = t.interesting >= candidates
