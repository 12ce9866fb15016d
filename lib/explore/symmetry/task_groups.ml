open Dolphin_semantics
module Residuals = Hashtbl.Make (Residual)
module Label = Task_isomorphism

module Executions = Hashtbl.Make (struct
    type t = Symmetry.execution

    let equal (e : t) (e' : t) = Residual.equal e.task e'.task && Shared.equal e.constant e'.constant
    let hash (e : t) = (Residual.hash e.task + (65599 * Shared.hash e.constant)) land max_int
  end)

(* By task, and by the parts that its automorphisms fix. *)
module Starts = Hashtbl.Make (struct
    type t = int * Tuples.t list

    let equal (r, ns) (r', ns') = r = r' && List.equal Tuples.equal ns ns'
    let hash (r, ns) = List.fold_left (fun h n -> (h * 65599) + Tuples.hash n) r ns land max_int
  end)

module Spaces = Hashtbl.Make (struct
    type t = Tuples.t

    let equal = Tuples.equal
    let hash n = Tuples.hash n land max_int
  end)

(* A task with its footprint, or [None] if it is symmetric with no N. *)
type task = { number : int; footprint : Footprint.t option }

(* [fixed] is the N that the group is known to fix. *)
type group = { group : (Automorphism.t * Task_group.t) option; fixed : unit Spaces.t }

type t = {
  tick : unit -> unit;
  assumed : Symmetry.t;
  breaks : (Symmetry.execution * Tuples.t) list;
  context : Task_isomorphism.context;
  footprints : Step_footprints.context;
  shareds : Task_group.shareds;
  groups : (int * Automorphism.orbit list, Task_group.t) Hashtbl.t;  (* by task *)
  executions : group Executions.t;
  tasks : task Residuals.t;
  automorphisms : Automorphism.t option Starts.t;
  handlers : (Label.label, Label.label list) Hashtbl.t;  (* the orbit of each, in all tasks *)
}

let create ~tick options program (assumed : Symmetry.t) (shareds : Task_group.shareds) =
  let with_breaks breaks =
    {
      tick;
      assumed;
      breaks;
      context = Task_isomorphism.context shareds.numbering options program;
      footprints = Step_footprints.context options program;
      shareds;
      groups = Hashtbl.create 8;
      executions = Executions.create 8;
      tasks = Residuals.create 8;
      automorphisms = Starts.create 8;
      handlers = Hashtbl.create 64;
    }
  in
  Option.map with_breaks assumed.tasks

(* {1 Labels} *)

(* Each of [labels] with its class in the equivalence that [pairs] generate. *)
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

(* Whether the handlers among labels have the orbits that they had in other tasks. If so, it is remembered. *)
let note_handlers f r equivalent =
  let handlers = List.filter fst (Task_isomorphism.closures r) in
  let is_handler (l, _) = List.exists (fun (_, (c : Core.closure)) -> l = Label.Code c.lambda.id) handlers in
  let equivalent = List.filter is_handler equivalent in
  let agrees (l, members) =
    match Hashtbl.find_opt f.handlers l with Some known -> known = members | None -> true
  in
  let agree = List.for_all agrees equivalent in
  if agree then List.iter (fun (l, members) -> Hashtbl.replace f.handlers l members) equivalent;
  agree

let note_no_group f r =
  let agree = note_handlers f r (classes (Task_isomorphism.labels r) []) in
  if not agree then raise (Symmetry.Broken (Symmetry.without_tasks f.assumed))

(* {1 Executions} *)

let automorphisms f r number ns =
  match Starts.find_opt f.automorphisms (number, ns) with
  | Some found -> found
  | None ->
    let found = Automorphism.find ~tick:f.tick f.context r ns in
    Starts.add f.automorphisms (number, ns) found;
    found

(* To find automorphisms takes long: those of [tuples] are asked for first, since a group will need them. *)
let task f r tuples =
  match Residuals.find_opt f.tasks r with
  | Some task -> task
  | None ->
    Dolphin_checker.Numbering.give f.shareds.numbering;
    let number = Residuals.length f.tasks in
    (* Where tasks are made, or code asks for idle vehicles, it matters which task holds each vehicle. *)
    let claims = Footprint.claims (Step_footprints.of_residual f.footprints r) in
    let has tuples = automorphisms f r number tuples <> None in
    let is_symmetric = (not claims) && (not (Residual.ensures r)) && (has [ tuples ] || has []) in
    if not is_symmetric then note_no_group f r;
    let footprint = if is_symmetric then Some (Step_footprints.of_residual f.footprints r) else None in
    let task = { number; footprint } in
    Residuals.add f.tasks r task;
    task

(* The part of [s] that no step with footprint [g] can change. *)
let constant (g : Footprint.t) (s : Shared.t) : Shared.t =
  if g.anything then { s with store = Store.empty; tuples = Tuples.empty Tuple_space.no_key }
  else
    let forget i store = Store.set i Core.Null store in
    let touched = Footprint.Pairs.union g.posts g.takes in
    let remove k n x =
      if Footprint.Pairs.(meet (singleton (k, Some (Value.normal x))) touched) then
        Option.value (Tuples.consume k x n) ~default:n
      else n
    in
    let remove_all n (k, xs) = List.fold_left (remove k) n xs in
    let tuples = List.fold_left remove_all s.tuples (Tuples.bindings s.tuples) in
    { s with store = Footprint.Globals.fold forget g.writes s.store; tuples }

(* A task whose symmetry is broken in more executions has one group for all. *)
let most_executions = 4

let breaks f (e : Symmetry.execution) =
  let of_task = List.filter (fun ((e' : Symmetry.execution), _) -> Residual.equal e.task e'.task) f.breaks in
  let is_same ((e' : Symmetry.execution), _) = Shared.equal e.constant e'.constant in
  let of_execution = List.filter is_same of_task in
  List.map snd (if List.length of_task > most_executions then of_task else of_execution)

let group_of f number (e : Symmetry.execution) (found : Automorphism.t) equivalent =
  match Hashtbl.find_opt f.groups (number, found.orbits) with
  | Some g -> g
  | None ->
    let g =
      Task_group.create f.context f.shareds ~number:(Hashtbl.length f.groups + 1) ~equivalent e.task found
    in
    Hashtbl.add f.groups (number, found.orbits) g;
    g

let find_group f number (e : Symmetry.execution) tuples =
  let labels = Task_isomorphism.labels e.task in
  let with_classes (found : Automorphism.t) = (found, classes labels found.labels) in
  match Option.map with_classes (automorphisms f e.task number (tuples :: breaks f e)) with
  | Some (found, equivalent) when note_handlers f e.task equivalent ->
    Some (found, group_of f number e found equivalent)
  | Some _ | None -> note_no_group f e.task; None

let group f number e tuples =
  match Executions.find_opt f.executions e with
  | Some group -> group
  | None ->
    Dolphin_checker.Numbering.give f.shareds.numbering;
    let group = { group = find_group f number e tuples; fixed = Spaces.create 8 } in
    Executions.add f.executions e group;
    group

let check_fixed f e group tuples =
  if not (Spaces.mem group.fixed tuples) then begin
    let fixes (found, _) = Automorphism.fixes (Task_isomorphism.skeletons f.context) found tuples in
    if not (Option.fold ~none:true ~some:fixes group.group) then
      raise (Symmetry.Broken { f.assumed with tasks = Some ((e, tuples) :: f.breaks) });
    Spaces.add group.fixed tuples ()
  end

(* Where a task may run without end, the fairness of a run depends on which part of the task makes each step. *)
let find f r ({ shared; _ } : Surroundings.t) =
  if Residual.may_go_round r then None else
    let { number; footprint } = task f r shared.tuples in
    let of_execution footprint =
      let e = { Symmetry.task = r; constant = constant footprint shared } in
      let group = group f number e shared.tuples in
      check_fixed f e group shared.tuples;
      Option.map snd group.group
    in
    Option.bind footprint of_execution

(* {1 What was found} *)

let equivalent_handlers f note =
  let once l members = if List.compare_length_with members 1 > 0 && List.hd members = l then note members in
  Hashtbl.iter once f.handlers

let is_used f = Hashtbl.length f.groups > 0
