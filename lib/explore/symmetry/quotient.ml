open Dolphin_semantics
open Component

module Numbered = Hashtbl.Make (struct
    type t = int * int

    let equal (a, b) (a', b') = Int.equal a a' && Int.equal b b'
    let hash (a, b) = ((a * 65599) + b) * 65599 land max_int
  end)

type t = {
  parts : Components.t;
  words : Encoding.t;
  kinds : int Numbered.t;  (* of parts, by symmetry, family and place there *)
  children : part tree list Numbered.t;  (* by symmetry and kind *)
}

let create parts words = { parts; words; kinds = Numbered.create 64; children = Numbered.create 64 }

let cover coverage = function
  | Task_isomorphism.Task site -> Coverage.reach coverage site
  | Code id -> Coverage.reach_code coverage id

(* What [r] begins in a state, those that the state stands for begin as well. *)
let reach_alike t g r =
  let reach label = List.iter (cover (Components.coverage t.parts)) (Symmetry.together g label) in
  let step (step : Residual.step) =
    match step.offer with
    | Start (p, _) -> reach (Task_isomorphism.Task p.task_site)
    | Perform c | Check c | Measure c -> reach (Task_isomorphism.Code c.lambda.id)
    | End_of _ | Expiry_of _ -> ()
  in
  Seq.iter step (Residual.steps r)

(* What stands side by side at the top has a kind, be it a part or a nest. *)
let kind t g (s : Layout.t) key (place : Layout.place) =
  match place.inside with
  | Some _ -> Symmetry.kind g (Encoding.residual s key place)
  | None -> (
      let part = Encoding.part s key place.from in
      let known = ((Symmetry.number g lsl 31) lor part.family.number, part.local) in
      match Numbered.find_opt t.kinds known with
      | Some kind -> kind
      | None ->
        let kind = Symmetry.kind g part.residual in
        Numbered.add t.kinds known kind;
        kind)

let children t g kind =
  let known = (Symmetry.number g, kind) in
  match Numbered.find_opt t.children known with
  | Some children -> children
  | None ->
    let r = Symmetry.residual g kind in
    let children = Components.children t.parts (Components.root t.parts) r in
    reach_alike t g r;
    Numbered.add t.children known children;
    children

let kinds t g (s : Layout.t) key = Array.of_list (List.map (kind t g s key) s.top)

let state t g s key shared : Symmetry.state =
  let kinds = kinds t g s key in
  Array.sort Int.compare kinds;
  { kinds; shared }

(* Few shapes are enough if what stands side by side is in an order of families. *)
let by_family tree tree' =
  let both (p : part) (p' : part) order =
    if order <> 0 then order
    else
      match Int.compare p.family.number p'.family.number with 0 -> Int.compare p.local p'.local | order -> order
  in
  let leaves = Component.leaves tree and leaves' = Component.leaves tree' in
  match List.compare_lengths leaves leaves' with
  | 0 -> List.fold_right2 both leaves leaves' 0
  | order -> order

let canonical t g (s : Layout.t) key shared ~into =
  let state, permutation = Symmetry.canonical g (kinds t g s key) shared in
  let trees = List.concat_map (children t g) (Array.to_list state.kinds) in
  Encoding.write_parts t.words into s.frame (List.stable_sort by_family trees) state.shared;
  permutation
