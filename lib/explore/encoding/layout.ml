open Dolphin_semantics

type frame = { number : int; machine : Machine.t; symmetry : Task_group.t option }

type place = {
  index : int;
  from : int;
  upto : int;
  inside : Component.path option;
  children : place list;
  mutable around : place option;
}

type t = {
  number : int;
  frame : frame;
  top : place list;
  families : Component.family array;
  leaves : place array;
  nests : place array;
  mutable word : int array;
  mutable shift : int array;
  mutable mask : int array;
  without : t option array;
  becoming : (int, t) Hashtbl.t;
}

(* {1 Trees} *)

let places count trees =
  let leaves = ref [] and nests = ref [] and position = ref 0 in
  let rec place : Component.family Component.tree -> place = function
    | Leaf _ ->
      let i = !position in
      incr position;
      let leaf = { index = i; from = i; upto = i + 1; inside = None; children = []; around = None } in
      leaves := leaf :: !leaves;
      leaf
    | Nest (path, children) ->
      let from = !position in
      let children = List.map place children in
      let index = count + List.length !nests in
      let nest = { index; from; upto = !position; inside = Some path; children; around = None } in
      List.iter (fun child -> child.around <- Some nest) children;
      nests := nest :: !nests;
      nest
  in
  let top = List.map place trees in
  (top, Array.of_list (List.rev !leaves), Array.of_list (List.rev !nests))

let create ~number frame trees =
  let families = Array.of_list (List.concat_map Component.leaves trees) in
  let top, leaves, nests = places (Array.length families) trees in
  {
    number;
    frame;
    top;
    families;
    leaves;
    nests;
    word = [||];
    shift = [||];
    mask = [||];
    without = Array.make (Array.length leaves + Array.length nests) None;
    becoming = Hashtbl.create 1;
  }

let rec above place level =
  match place.around with
  | Some nest when level > 0 -> above nest (level - 1)
  | Some _ | None -> place

let replaced l place trees =
  let rec tree p : Component.family Component.tree list =
    if p == place then trees
    else
      match p.inside with
      | None -> [ Leaf l.families.(p.from) ]
      | Some path -> [ Nest (path, List.concat_map tree p.children) ]
  in
  List.concat_map tree l.top

let key (frame : frame) trees =
  let rec add (tree : Component.family Component.tree) key =
    match tree with
    | Leaf family -> family.number :: key
    | Nest (path, children) -> (-1 - path.id) :: List.fold_right add children (-1 :: key)
  in
  frame.number :: List.fold_right add trees []

let rec residual l place component =
  match place.inside with
  | None -> component place.from
  | Some path ->
    let branches = List.map (fun child -> residual l child component) place.children in
    Components.around path (Parallel (Branches.of_list branches))

(* {1 Words} *)

(* So that no word is negative. *)
let bits_of_word = 62

type widths = { reserved : int; layout : int; shared : int }

let lay_out widths l =
  let n = Array.length l.families in
  l.word <- Array.make n 0;
  l.shift <- Array.make n 0;
  l.mask <- Array.make n 0;
  let place (word, bit) i (family : Component.family) =
    let word, bit = if bit + family.width > bits_of_word then (word + 1, 0) else (word, bit) in
    l.word.(i) <- word;
    l.shift.(i) <- bit;
    l.mask.(i) <- (1 lsl family.width) - 1;
    (word, bit + family.width)
  in
  let rec from i at = if i = n then at else from (i + 1) (place at i l.families.(i)) in
  fst (from 0 (0, widths.reserved + widths.layout + widths.shared)) + 1

let local l key i = (key.(l.word.(i)) lsr l.shift.(i)) land l.mask.(i)
let put l key i n = key.(l.word.(i)) <- key.(l.word.(i)) lor (n lsl l.shift.(i))
