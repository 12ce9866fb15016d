open Dolphin_semantics

type shareds = {
  numbering : Dolphin_checker.Numbering.t;
  number : Surroundings.t -> int;
  value : int -> Surroundings.t;
}

module Keys = Dolphin_checker.Interner.Make (struct
    type t = string

    let equal = String.equal
    let hash = Hashtbl.hash
  end)

module Residuals = Hashtbl.Make (Residual)

module Images = Hashtbl.Make (struct
    type t = int * int list

    let equal (x, xs) (y, ys) = Int.equal x y && List.equal Int.equal xs ys
    let hash (x, xs) = List.fold_left (fun h x -> (h * 65599) + x) x xs land max_int
  end)

(* The blocks with pairs in a component class, or in the shared part; and a key for the role of each block there,
   which a permutation does not change. *)
type signature = { blocks : int array; roles : int array }

type component_class = { representative : Residual.t; signature : signature }
type state = { classes : int array; shared : int }
type permutation = int array

(* Blocks are numbered from 0, those of an orbit next to each other. *)
type t = {
  number : int;
  isomorphism : Task_isomorphism.context;
  shareds : shareds;
  pairs : int array array;  (* by block *)
  orbit : int array;  (* by block: the first block of its orbit *)
  owner : (int, int * int) Hashtbl.t;  (* by pair: its block, and its position there *)
  label_orbits : (Task_isomorphism.label, int) Hashtbl.t;
  equivalent : (Task_isomorphism.label, Task_isomorphism.label list) Hashtbl.t;
  closures : (string, Core.closure) Hashtbl.t;  (* by skeleton, label's orbit and pairs *)
  keys : Keys.t;  (* of classes *)
  mutable classes : component_class array;
  class_of_residual : int Residuals.t;
  roles : Keys.t;
  shared_signatures : (int, signature) Hashtbl.t;
  class_images : int Images.t;  (* by class, and the images of its blocks *)
  shared_images : int Images.t;
}

let number g = g.number
let skeletons g = Task_isomorphism.skeletons g.isomorphism
let equivalent g label = Option.value (Hashtbl.find_opt g.equivalent label) ~default:[ label ]

(* {1 Permutations} *)

let identity g = Array.init (Array.length g.pairs) Fun.id
let compose p q = Array.map (fun x -> p.(x)) q

let is_identity p =
  let rec from x = x = Array.length p || (p.(x) = x && from (x + 1)) in
  from 0

(* Transpositions of neighbours generate the group. *)
let generators g =
  let transposition x =
    let p = identity g in
    p.(x) <- x + 1;
    p.(x + 1) <- x;
    p
  in
  let is_inside x = x + 1 < Array.length g.orbit && g.orbit.(x) = g.orbit.(x + 1) in
  List.map transposition (List.filter is_inside (List.init (Array.length g.orbit) Fun.id))

(* {1 Component classes} *)

let label_orbit g label =
  match Hashtbl.find_opt g.label_orbits label with Some c -> string_of_int c | None -> "?"

(* A pair as seen from [block]: its own, of another block of some orbit, or of no block. *)
let seen_from g block n =
  match Hashtbl.find_opt g.owner n with
  | None -> string_of_int n
  | Some (owner, position) ->
    if owner = block then Printf.sprintf "@%d" position else Printf.sprintf "%d#%d" g.orbit.(owner) position

let signature_of_residual g r =
  let owner n = Option.map fst (Hashtbl.find_opt g.owner n) in
  let pairs = Array.to_list (Task_isomorphism.pairs g.isomorphism r) in
  let blocks = Array.of_list (List.sort_uniq Int.compare (List.filter_map owner pairs)) in
  let role block =
    let pair = seen_from g block in
    Keys.number g.roles (Task_isomorphism.key g.isomorphism ~sorted:true ~pair ~label:(label_orbit g) r)
  in
  { blocks; roles = Array.map role blocks }

let add_class g k r =
  let found = { representative = r; signature = signature_of_residual g r } in
  if k = Array.length g.classes then g.classes <- Array.append g.classes (Array.make (max 16 k) found);
  g.classes.(k) <- found

let class_of g r =
  match Residuals.find_opt g.class_of_residual r with
  | Some k -> k
  | None ->
    let known = Keys.count g.keys in
    let key = Task_isomorphism.key g.isomorphism ~sorted:true ~pair:string_of_int ~label:(label_orbit g) r in
    let k = Keys.number g.keys key in
    if k = known then add_class g k r;
    Residuals.add g.class_of_residual r k;
    k

let representative g k = g.classes.(k).representative

(* {1 What is shared} *)

let signature_of_tuples g tuples =
  let found = Hashtbl.create 16 in
  let note k at x =
    let at = if Tuples.is_ordered k tuples then at else 0 in
    match Hashtbl.find_opt g.owner (Skeleton.pair (skeletons g) k x) with
    | None -> ()
    | Some (block, position) ->
      let before = Option.value (Hashtbl.find_opt found block) ~default:[] in
      Hashtbl.replace found block ((position, at) :: before)
  in
  List.iter (fun (k, xs) -> List.iteri (note k) xs) (Tuples.bindings tuples);
  let blocks = List.sort Int.compare (Hashtbl.fold (fun block _ blocks -> block :: blocks) found []) in
  let text (position, at) = Printf.sprintf "%d.%d" position at in
  let role block =
    let places = List.sort Stdlib.compare (Hashtbl.find found block) in
    Keys.number g.roles ("N" ^ String.concat "," (List.map text places))
  in
  { blocks = Array.of_list blocks; roles = Array.of_list (List.map role blocks) }

let shared_signature g s =
  match Hashtbl.find_opt g.shared_signatures s with
  | Some signature -> signature
  | None ->
    let signature = signature_of_tuples g (g.shareds.value s).shared.tuples in
    Hashtbl.add g.shared_signatures s signature;
    signature

(* {1 Images} *)

let rename g (p : permutation) n =
  match Hashtbl.find_opt g.owner n with
  | None -> n
  | Some (block, position) -> g.pairs.(p.(block)).(position)

let closure_key g rename ~handler (c : Core.closure) =
  let skeleton = Skeleton.of_code (skeletons g) ~handler c in
  let pairs = String.concat "," (Array.to_list (Array.map (fun n -> string_of_int (rename n)) skeleton.pairs)) in
  Printf.sprintf "%b %s %d %s" handler (label_orbit g (Code c.lambda.id)) skeleton.number pairs

let image_of_closure g p ~handler c =
  match Hashtbl.find_opt g.closures (closure_key g (rename g p) ~handler c) with
  | Some c -> c
  | None -> invalid_arg "Task_group.image_of_closure: an automorphism leads out of the task"

let image_of_residual g p r =
  let code = image_of_closure g p in
  let without _ = invalid_arg "Task_group: a task in which tasks are made has no group" in
  let rec part r = Residual.map mapper r
  and mapper =
    { Residual.part; code = code ~handler:false; handler = code ~handler:true; maker = without; value = without;
      term = without; vehicle = Fun.id }
  in
  part r

(* The image of [x], which has no blocks but [blocks]; memoised. *)
let image known x blocks (p : permutation) find =
  if Array.for_all (fun block -> p.(block) = block) blocks then x
  else
    let key = (x, Array.to_list (Array.map (fun block -> p.(block)) blocks)) in
    match Images.find_opt known key with
    | Some x' -> x'
    | None ->
      let x' = find () in
      Images.add known key x';
      x'

let image_of_class g p k =
  let { representative; signature } = g.classes.(k) in
  image g.class_images k signature.blocks p (fun () -> class_of g (image_of_residual g p representative))

let image_of_shared g p s =
  image g.shared_images s (shared_signature g s).blocks p (fun () ->
      let { Surroundings.shared; outside } = g.shareds.value s in
      let tuples = Automorphism.renamed (skeletons g) (rename g p) shared.tuples in
      g.shareds.number { shared = { shared with tuples }; outside })

let sorted classes =
  Array.sort Int.compare classes;
  classes

let image_of_state g p classes shared =
  { classes = Array.map (image_of_class g p) classes; shared = image_of_shared g p shared }

let apply g p { classes; shared } =
  let state = image_of_state g p classes shared in
  { state with classes = sorted state.classes }

let state g rs shared = { classes = sorted (Array.of_list (List.map (class_of g) rs)); shared }

let orbit_of_shared g s =
  let found = Hashtbl.create 8 and queue = Queue.create () in
  let add p s =
    if not (Hashtbl.mem found s) then begin
      Hashtbl.add found s ();
      Queue.add (s, p) queue
    end
  in
  add (identity g) s;
  let generators = generators g in
  let rec go orbit =
    match Queue.take_opt queue with
    | None -> List.rev orbit
    | Some (s, p) ->
      List.iter (fun q -> add (compose q p) (image_of_shared g q s)) generators;
      go ((s, p) :: orbit)
  in
  go []

(* {1 Canonical states} *)

(* By block: its roles in all that it is in, sorted. *)
let roles g classes shared =
  let roles = Array.make (Array.length g.pairs) [] in
  let add { blocks; roles = here } = Array.iteri (fun i block -> roles.(block) <- here.(i) :: roles.(block)) blocks in
  Array.iter (fun k -> add g.classes.(k).signature) classes;
  add (shared_signature g shared);
  Array.map (function ([] | [ _ ]) as few -> few | several -> List.sort Int.compare several) roles

(* The permutation that sorts the blocks of each orbit by their roles. Of those with the same roles, blocks that are in
   place stay there: so where one block changes its roles, few are moved, and few images are needed. *)
let sorting g roles =
  let n = Array.length roles in
  let compare_roles x y = List.compare Int.compare roles.(x) roles.(y) in
  let order x y = match Int.compare g.orbit.(x) g.orbit.(y) with 0 -> compare_roles x y | order -> order in
  let rec in_order x = x + 1 >= n || (order x (x + 1) <= 0 && in_order (x + 1)) in
  let p = Array.init n Fun.id in
  if not (in_order 0) then begin
    let blocks = Array.init n Fun.id in
    Array.stable_sort order blocks;
    let is_in_place place = compare_roles place blocks.(place) = 0 in
    let moved = List.filter (fun place -> not (is_in_place place)) (Array.to_list p) in
    let to_move = List.stable_sort order moved in
    List.iter2 (fun place block -> p.(block) <- place) moved to_move
  end;
  p

let canonical g classes shared =
  let p = sorting g (roles g classes shared) in
  if is_identity p then ({ classes; shared }, p) else (image_of_state g p classes shared, p)

(* {1 Making groups} *)

let firsts orbits =
  let of_orbit (first, found) orbit =
    let n = Array.length orbit in
    (first + n, Array.make n first :: found)
  in
  Array.concat (List.rev (snd (List.fold_left of_orbit (0, []) orbits)))

let create isomorphism shareds ~number ~equivalent r (found : Automorphism.t) =
  let pairs = Array.concat found.orbits in
  let owner = Hashtbl.create 64 and label_orbits = Hashtbl.create 64 and by_label = Hashtbl.create 64 in
  Array.iteri (fun block own -> Array.iteri (fun position n -> Hashtbl.replace owner n (block, position)) own) pairs;
  List.iter (fun (l, all) -> Hashtbl.replace by_label l all) equivalent;
  List.iteri (fun i (_, all) -> List.iter (fun l -> Hashtbl.replace label_orbits l i) all) equivalent;
  let g =
    {
      number;
      isomorphism;
      shareds;
      pairs;
      orbit = firsts found.orbits;
      owner;
      label_orbits;
      equivalent = by_label;
      closures = Hashtbl.create 64;
      keys = Keys.create shareds.numbering;
      classes = [||];
      class_of_residual = Residuals.create 64;
      roles = Keys.create shareds.numbering;
      shared_signatures = Hashtbl.create 64;
      class_images = Images.create 64;
      shared_images = Images.create 64;
    }
  in
  let add (handler, c) = Hashtbl.replace g.closures (closure_key g Fun.id ~handler c) c in
  List.iter add (List.rev (Task_isomorphism.closures r));
  g
