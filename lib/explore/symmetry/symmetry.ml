open Dolphin_semantics

type shareds = { number : Shared.t -> int; value : int -> Shared.t }

module Keys = Dolphin_checker.Interner.Make (struct
    type t = string

    let equal = String.equal
    let hash = Hashtbl.hash
  end)

module Residuals = Hashtbl.Make (Residual)

module Moves = Hashtbl.Make (struct
    type t = int * int list

    let equal (x, xs) (y, ys) = Int.equal x y && List.equal Int.equal xs ys
    let hash (x, xs) = List.fold_left (fun h x -> (h * 65599) + x) x xs land max_int
  end)

(* Of a kind of part, or of what is shared: the things whose pairs are in it, and for each of them how, in a way that
   stays the same when things change places. *)
type profile = { things : int array; looks : int array }

type kind = { residual : Residual.t; of_part : profile }
type state = { kinds : int array; shared : int }
type permutation = int array

(* Things of all rings are numbered through. *)
type t = {
  number : int;
  alike : Task_isomorphism.context;
  shareds : shareds;
  pairs : int array array;  (* by thing *)
  ring : int array;  (* by thing: the first thing of its ring *)
  owner : (int, int * int) Hashtbl.t;  (* by pair: thing, and place among its pairs *)
  classes : (Task_isomorphism.label, int) Hashtbl.t;
  members : (Task_isomorphism.label, Task_isomorphism.label list) Hashtbl.t;  (* of its class *)
  closures : (string, Core.closure) Hashtbl.t;  (* by class, pattern and pairs *)
  keys : Keys.t;  (* of kinds *)
  mutable kinds : kind array;
  by_residual : int Residuals.t;
  looks : Keys.t;
  profiles : (int, profile) Hashtbl.t;  (* of what is shared *)
  moved_kinds : int Moves.t;  (* by kind, and what its things become *)
  moved_shareds : int Moves.t;
}

let number g = g.number
let patterns g = Task_isomorphism.patterns g.alike
let identity g = Array.init (Array.length g.pairs) Fun.id
let compose p q = Array.map (fun x -> p.(x)) q
let is_identity p =
  let rec from x = x = Array.length p || (p.(x) = x && from (x + 1)) in
  from 0

let together g label = Option.value (Hashtbl.find_opt g.members label) ~default:[ label ]

(* {1 Kinds} *)

let class_of g label = match Hashtbl.find_opt g.classes label with Some c -> string_of_int c | None -> "?"

(* Pairs as one thing sees them: its own, those of the others of its ring, those of other rings, and the rest. *)
let seen_by g thing n =
  match Hashtbl.find_opt g.owner n with
  | None -> string_of_int n
  | Some (owner, place) ->
    if owner = thing then Printf.sprintf "@%d" place else Printf.sprintf "%d#%d" g.ring.(owner) place

let things_of g pairs =
  let thing n = Option.map fst (Hashtbl.find_opt g.owner n) in
  Array.of_list (List.sort_uniq Int.compare (List.filter_map thing pairs))

let part_profile g r =
  let label = class_of g in
  let things = things_of g (Array.to_list (Task_isomorphism.pairs g.alike r)) in
  let look thing = Keys.number g.looks (Task_isomorphism.key g.alike ~sorted:true ~pair:(seen_by g thing) ~label r) in
  { things; looks = Array.map look things }

let kind g r =
  match Residuals.find_opt g.by_residual r with
  | Some k -> k
  | None ->
    let key = Task_isomorphism.key g.alike ~sorted:true ~pair:string_of_int ~label:(class_of g) r in
    let known = Keys.count g.keys in
    let k = Keys.number g.keys key in
    if k = known then begin
      let kind = { residual = r; of_part = part_profile g r } in
      if k = Array.length g.kinds then g.kinds <- Array.append g.kinds (Array.make (max 16 k) kind);
      g.kinds.(k) <- kind
    end;
    Residuals.add g.by_residual r k;
    k

let residual g k = g.kinds.(k).residual

(* {1 What is shared} *)

let find_shared_profile g s =
  let found = Hashtbl.create 16 in
  let tuples = (g.shareds.value s).tuples in
  let look k at x =
    let place = if Tuples.is_ordered k tuples then at else 0 in
    match Hashtbl.find_opt g.owner (Skeleton.pair (patterns g) k x) with
    | None -> ()
    | Some (thing, own) ->
      let before = Option.value (Hashtbl.find_opt found thing) ~default:[] in
      Hashtbl.replace found thing ((own, place) :: before)
  in
  List.iter (fun (k, xs) -> List.iteri (look k) xs) (Tuples.bindings tuples);
  let things = Array.of_list (List.sort Int.compare (Hashtbl.fold (fun thing _ things -> thing :: things) found [])) in
  let text (own, place) = Printf.sprintf "%d.%d" own place in
  let look thing =
    Keys.number g.looks ("N" ^ String.concat "," (List.map text (List.sort Stdlib.compare (Hashtbl.find found thing))))
  in
  { things; looks = Array.map look things }

let shared_profile g s =
  match Hashtbl.find_opt g.profiles s with
  | Some profile -> profile
  | None ->
    let profile = find_shared_profile g s in
    Hashtbl.add g.profiles s profile;
    profile

(* {1 Permutations} *)

let rename g (p : permutation) n =
  match Hashtbl.find_opt g.owner n with
  | None -> n
  | Some (thing, place) -> g.pairs.(p.(thing)).(place)

let closure_key g pairs ~handler (c : Core.closure) =
  let pattern = Skeleton.of_code (patterns g) ~handler c in
  let pairs = String.concat "," (Array.to_list (Array.map string_of_int (Array.map pairs pattern.pairs))) in
  Printf.sprintf "%b %s %d %s" handler (class_of g (Code c.lambda.id)) pattern.skeleton pairs

let moved_closure g p ~handler c =
  match Hashtbl.find_opt g.closures (closure_key g (rename g p) ~handler c) with
  | Some c -> c
  | None -> invalid_arg "Symmetry.moved_closure: a checked permutation leads out of the task"

let rec moved_residual g p (r : Residual.t) : Residual.t =
  let go = moved_residual g p and code = moved_closure g p ~handler:false in
  let branch (b : Residual.branch) : Residual.branch = { guard = code b.guard; body = go b.body } in
  match r with
  | Ready _ | Running _ | Idle _ -> r
  | Action c -> Action (code c)
  | Condition c -> Condition (code c)
  | Sequence (a, rest) -> Sequence (go a, List.map go rest)
  | Parallel rs -> Parallel (List.map go rs)
  | All_of (a, bs) -> All_of (Option.map go a, List.map branch bs)
  | One_of bs -> One_of (List.map branch bs)
  | Until (c, a) -> Until (code c, go a)
  | During ({ duration = Given_by c; _ } as d) -> During { d with duration = Given_by (code c); body = go d.body }
  | During ({ duration = Seconds _; _ } as d) -> During { d with body = go d.body }
  | Watch (a, c) -> Watch (go a, moved_closure g p ~handler:true c)

(* [x] moved by [p], which matters to it only for its things. *)
let moved known x things (p : permutation) move =
  if Array.for_all (fun thing -> p.(thing) = thing) things then x
  else
    let key = (x, Array.to_list (Array.map (fun thing -> p.(thing)) things)) in
    match Moves.find_opt known key with
    | Some x' -> x'
    | None ->
      let x' = move () in
      Moves.add known key x';
      x'

let moved_kind g p k =
  moved g.moved_kinds k g.kinds.(k).of_part.things p (fun () -> kind g (moved_residual g p (residual g k)))

let moved_shared g p s =
  moved g.moved_shareds s (shared_profile g s).things p (fun () ->
      let shared = g.shareds.value s in
      g.shareds.number { shared with tuples = Automorphism.renamed (patterns g) (rename g p) shared.tuples })

let sorted kinds =
  Array.sort Int.compare kinds;
  kinds

let moved_state g p kinds shared = { kinds = Array.map (moved_kind g p) kinds; shared = moved_shared g p shared }

let apply g p { kinds; shared } =
  let state = moved_state g p kinds shared in
  { state with kinds = sorted state.kinds }

(* {1 Canonical states} *)

(* By thing: how it looks in all that it is in. *)
let looks g kinds shared =
  let looks = Array.make (Array.length g.pairs) [] in
  let add { things; looks = seen } =
    Array.iteri (fun i thing -> looks.(thing) <- seen.(i) :: looks.(thing)) things
  in
  Array.iter (fun k -> add g.kinds.(k).of_part) kinds;
  add (shared_profile g shared);
  Array.map (function ([] | [ _ ]) as one -> one | several -> List.sort Int.compare several) looks

(* Things go to the places in their ring by their looks. *)
let sorting g looks =
  let n = Array.length looks in
  let order x y =
    match Int.compare g.ring.(x) g.ring.(y) with
    | 0 -> (match List.compare Int.compare looks.(x) looks.(y) with 0 -> Int.compare x y | order -> order)
    | order -> order
  in
  let rec in_order x = x + 1 >= n || (order x (x + 1) < 0 && in_order (x + 1)) in
  let p = Array.init n Fun.id in
  if not (in_order 0) then begin
    let things = Array.init n Fun.id in
    Array.sort order things;
    Array.iteri (fun place thing -> p.(thing) <- place) things
  end;
  p

let state g rs shared = { kinds = sorted (Array.of_list (List.map (kind g) rs)); shared }

let canonical g kinds shared =
  let p = sorting g (looks g kinds shared) in
  if is_identity p then ({ kinds; shared }, p) else (moved_state g p kinds shared, p)

let images g s =
  let found = Hashtbl.create 8 and queue = Queue.create () in
  let add p s =
    if not (Hashtbl.mem found s) then begin
      Hashtbl.add found s ();
      Queue.add (s, p) queue
    end
  in
  add (identity g) s;
  let swap thing =
    let p = identity g in
    p.(thing) <- thing + 1;
    p.(thing + 1) <- thing;
    p
  in
  let neighbours = List.filter (fun x -> x + 1 < Array.length g.ring && g.ring.(x) = g.ring.(x + 1)) in
  let swaps = List.map swap (neighbours (List.init (Array.length g.ring) Fun.id)) in
  let rec go images =
    match Queue.take_opt queue with
    | None -> List.rev images
    | Some (s, p) ->
      List.iter (fun swap -> add (compose swap p) (moved_shared g swap s)) swaps;
      go ((s, p) :: images)
  in
  go []

(* {1 Making groups} *)

let create alike shareds ~number ~classes r (found : Automorphism.t) =
  let pairs = Array.concat found.rings in
  let ring_of first ring = Array.make (Array.length ring) first in
  let _, ring =
    List.fold_left
      (fun (first, rings) ring -> (first + Array.length ring, Array.append rings (ring_of first ring)))
      (0, [||]) found.rings
  in
  let owner = Hashtbl.create 64 and by_label = Hashtbl.create 64 and members = Hashtbl.create 64 in
  List.iter (fun (l, all) -> Hashtbl.replace members l all) classes;
  Array.iteri (fun thing own -> Array.iteri (fun place n -> Hashtbl.replace owner n (thing, place)) own) pairs;
  List.iteri (fun i (_, members) -> List.iter (fun l -> Hashtbl.replace by_label l i) members) classes;
  let g =
    {
      number;
      alike;
      shareds;
      pairs;
      ring;
      owner;
      classes = by_label;
      members;
      closures = Hashtbl.create 64;
      keys = Keys.create ();
      kinds = [||];
      by_residual = Residuals.create 64;
      looks = Keys.create ();
      profiles = Hashtbl.create 64;
      moved_kinds = Moves.create 64;
      moved_shareds = Moves.create 64;
    }
  in
  let add (handler, c) = Hashtbl.replace g.closures (closure_key g Fun.id ~handler c) c in
  List.iter add (List.rev (Task_isomorphism.closures r));
  g
