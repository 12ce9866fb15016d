open Dolphin_semantics
module Residuals = Hashtbl.Make (Residual)

exception Unclear

(* By task and N. *)
module Executions = Hashtbl.Make (struct
    type t = int * Tuples.t

    let equal (r, n) (r', n') = r = r' && Tuples.equal n n'
    let hash (r, n) = (r + (65599 * Tuples.hash n)) land max_int
  end)

type t = {
  context : Task_isomorphism.context;
  shareds : Symmetry.shareds;
  groups : (int * Automorphism.ring list, Symmetry.t) Hashtbl.t;  (* by task *)
  found : Symmetry.t option Executions.t;
  tasks : int Residuals.t;
  handlers : (Task_isomorphism.label, Task_isomorphism.label list) Hashtbl.t;  (* what each can change places with, wherever it is executed *)
}

let create options program shareds =
  {
    context = Task_isomorphism.context options program;
    shareds;
    groups = Hashtbl.create 8;
    found = Executions.create 8;
    tasks = Residuals.create 8;
    handlers = Hashtbl.create 64;
  }

(* The labels of a task, each with all that can change places with it. *)
let classes labels pairs =
  let parents = Hashtbl.create 16 in
  let rec root l = match Hashtbl.find_opt parents l with Some l' when l' <> l -> root l' | Some _ | None -> l in
  let unite (a, b) =
    let a = root a and b = root b in
    if a <> b then Hashtbl.replace parents (max a b) (min a b)
  in
  List.iter unite pairs;
  let members = Hashtbl.create 16 in
  let labels = List.sort_uniq Stdlib.compare labels in
  List.iter (fun l -> Hashtbl.add members (root l) l) labels;
  List.map (fun l -> (l, List.sort Stdlib.compare (Hashtbl.find_all members (root l)))) labels

(* Handlers that are alike in one task are alike in all. *)
let agree f handlers =
  List.for_all
    (fun (l, members) -> match Hashtbl.find_opt f.handlers l with Some known -> known = members | None -> true)
    handlers

let remember f handlers = List.iter (fun (l, members) -> Hashtbl.replace f.handlers l members) handlers

let handlers_of r classes =
  let handlers = List.filter fst (Task_isomorphism.closures r) in
  let is_handler (l, _) = List.exists (fun (_, (c : Core.closure)) -> l = Task_isomorphism.Code c.lambda.id) handlers in
  List.filter is_handler classes

let task f r =
  match Residuals.find_opt f.tasks r with
  | Some i -> i
  | None ->
    let i = Residuals.length f.tasks in
    Residuals.add f.tasks r i;
    i

let find_group f r tuples =
  let labels = Task_isomorphism.labels r in
  let known (found : Automorphism.t) =
    let classes = classes labels found.labels in
    (found, classes, handlers_of r classes)
  in
  match Option.map known (Automorphism.find f.context r tuples) with
  | Some (found, classes, handlers) when agree f handlers ->
    remember f handlers;
    let key = (task f r, found.rings) in
    (match Hashtbl.find_opt f.groups key with
     | Some g -> Some g
     | None ->
       let g = Symmetry.create f.context f.shareds ~number:(Hashtbl.length f.groups + 1) ~classes r found in
       Hashtbl.add f.groups key g;
       Some g)
  | Some _ | None ->
    let alone = handlers_of r (classes labels []) in
    if not (agree f alone) then raise Unclear;
    remember f alone;
    None

let find f r (shared : Shared.t) =
  let key = (task f r, shared.tuples) in
  match Executions.find_opt f.found key with
  | Some group -> group
  | None ->
    let group = find_group f r shared.tuples in
    Executions.add f.found key group;
    group

let handlers_alike f note =
  let once l members = if List.compare_length_with members 1 > 0 && List.hd members = l then note members in
  Hashtbl.iter once f.handlers

let is_used f = Hashtbl.length f.groups > 0
