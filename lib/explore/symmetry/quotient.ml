open Dolphin_semantics
open Component

module Numbered = Hashtbl.Make (struct
    type t = int * int

    let equal (a, b) (a', b') = Int.equal a a' && Int.equal b b'
    let hash (a, b) = ((a * 65599) + b) * 65599 land max_int
  end)

type t = {
  components : Components.t;
  encoding : Encoding.t;
  classes : int Numbered.t;  (* of components, by group and family, and number in the family *)
  children : component tree list Numbered.t;  (* by group and class *)
}

let create components encoding = { components; encoding; classes = Numbered.create 64; children = Numbered.create 64 }

let cover coverage = function
  | Task_isomorphism.Task site -> Coverage.reach coverage site
  | Code id -> Coverage.reach_code coverage id

(* The images of a task started by [r] in a state start in other states of the orbit. *)
let reach_orbit t g r =
  let reach label = List.iter (cover (Components.coverage t.components)) (Task_group.equivalent g label) in
  let step (Task_rules.Step { offer; _ }) =
    match offer with
    | Start (p, _) -> reach (Task_isomorphism.Task p.task_site)
    | Perform c -> reach (Task_isomorphism.Code c.lambda.id)
    | Check c -> reach (Task_isomorphism.Code c.lambda.id)
    | Guard_false c -> reach (Task_isomorphism.Code c.lambda.id)
    | Guard_either c -> reach (Task_isomorphism.Code c.lambda.id)
    | Guard_values c -> reach (Task_isomorphism.Code c.lambda.id)
    | Measure c -> reach (Task_isomorphism.Code c.lambda.id)
    | Make (c, _, _) -> reach (Task_isomorphism.Code c.lambda.id)
    | Allocate _ | End_of _ | Expiry_of _ | Answer_to _ | Recruit_for _ -> ()
  in
  Seq.iter step (Task_rules.steps r)

(* Of a component or a nest at the top. *)
let class_at t g (s : Layout.t) key (place : Layout.place) =
  match place.inside with
  | Some _ -> Task_group.class_of g (Encoding.residual s key place)
  | None -> (
      let component = Encoding.component s key place.from in
      let known = ((Task_group.number g lsl 31) lor component.family.number, component.local) in
      match Numbered.find_opt t.classes known with
      | Some found -> found
      | None ->
        let found = Task_group.class_of g component.residual in
        Numbered.add t.classes known found;
        found)

let classes t g (s : Layout.t) key = Array.of_list (List.map (class_at t g s key) s.top)

let state t g s key shared : Task_group.state =
  let classes = classes t g s key in
  Array.sort Int.compare classes;
  { classes; shared }

let children t g found =
  let known = (Task_group.number g, found) in
  match Numbered.find_opt t.children known with
  | Some children -> children
  | None ->
    let r = Task_group.representative g found in
    let children = Components.children t.components (Components.root t.components) r in
    reach_orbit t g r;
    Numbered.add t.children known children;
    children

(* In the order of families there are fewer layouts. *)
let by_family tree tree' =
  let both (p : component) (p' : component) order =
    if order <> 0 then order
    else
      match Int.compare p.family.number p'.family.number with 0 -> Int.compare p.local p'.local | order -> order
  in
  let leaves = Component.leaves tree and leaves' = Component.leaves tree' in
  match List.compare_lengths leaves leaves' with
  | 0 -> List.fold_right2 both leaves leaves' 0
  | order -> order

let canonical t g (s : Layout.t) key shared ~into =
  let state, permutation = Task_group.canonical g (classes t g s key) shared in
  let trees = List.concat_map (children t g) (Array.to_list state.classes) in
  Encoding.write_components t.encoding into s.frame (List.stable_sort by_family trees) state.shared;
  permutation
