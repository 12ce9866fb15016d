open Part

type t = {
  parts : Parts.t;
  words : Words.t;
  kinds : (int * int * int, int) Hashtbl.t;  (* of parts, by symmetry, family and place there *)
  children : (int * int, part tree list) Hashtbl.t;  (* by symmetry and kind *)
}

let create parts words = { parts; words; kinds = Hashtbl.create 64; children = Hashtbl.create 64 }

(* What stands side by side at the top has a kind, be it a part or a nest. *)
let kind t g (s : Shape.t) key (place : Shape.place) =
  match place.inside with
  | Some _ -> Symmetry.kind g (Words.residual s key place)
  | None -> (
      let part = Words.part s key place.from in
      let known = (Symmetry.number g, part.family.number, part.local) in
      match Hashtbl.find_opt t.kinds known with
      | Some kind -> kind
      | None ->
        let kind = Symmetry.kind g part.residual in
        Hashtbl.add t.kinds known kind;
        kind)

let children t g kind =
  let known = (Symmetry.number g, kind) in
  match Hashtbl.find_opt t.children known with
  | Some children -> children
  | None ->
    let children = Parts.children t.parts (Parts.root t.parts) (Symmetry.residual g kind) in
    Hashtbl.add t.children known children;
    children

let kinds t g (s : Shape.t) key = Array.of_list (List.map (kind t g s key) s.top)

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
  let leaves = Part.leaves tree and leaves' = Part.leaves tree' in
  match List.compare_lengths leaves leaves' with
  | 0 -> List.fold_right2 both leaves leaves' 0
  | order -> order

let canonical t g (s : Shape.t) key shared ~into =
  let state, permutation = Symmetry.canonical g (kinds t g s key) shared in
  let trees = List.concat_map (children t g) (Array.to_list state.kinds) in
  Words.write_parts t.words into s.frame (List.stable_sort by_family trees) state.shared;
  permutation
