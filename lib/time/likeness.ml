open Dolphin_semantics
open Dolphin_environment
module Footprint = Dolphin_explore.Footprint
module Skeleton = Dolphin_explore.Skeleton
module Pairs = Footprint.Pairs

type label = { name : string; vehicle : Core.vehicle; site : Core.site }

type execution = {
  number : int;
  orbits : (label, int) Hashtbl.t;
  members : (int, label list) Hashtbl.t;  (* of orbits *)
  pairs : (int, int) Hashtbl.t;  (* those that may be renamed, each with its orbit *)
  renamed : (int, unit) Hashtbl.t;  (* those that some automorphism renames *)
}

module States = Hashtbl.Make (struct
    type t = Timed.state

    let equal = Timed.equal
    let hash = Timed.hash
  end)

(* What no step of a task changes, by number. *)
module Constants = Hashtbl.Make (struct
    type t = Configuration.t * Timed.state

    let equal ((c, s) : t) ((c', s') : t) =
      Environment.compare s.outside s'.outside = 0
      && Stdlib.compare (s.elsewhere, s.patience) (s'.elsewhere, s'.patience) = 0
      && Configuration.equal c c'

    let hash ((c, _) : t) = Configuration.hash c
  end)

type t = {
  options : Timed.options;
  skeletons : Skeleton.context;
  constants : int Constants.t;
  executions : execution option States.t;
  apart : Core.vehicle option;  (* it is like no other vehicle *)
  possible : bool;
}

let create ?apart (options : Timed.options) =
  let skeletons = Skeleton.context (Dolphin_checker.Numbering.create ()) options.program in
  { options; apart; skeletons; constants = Constants.create 64; executions = States.create 8;
    possible = Inert.names_are_free options }

let number e = e.number

let orbit e label =
  match Hashtbl.find_opt e.orbits label with Some orbit -> List.rev (Hashtbl.find e.members orbit) | None -> [ label ]

(* {1 Trees} *)

(* A residual as a tree of texts without names. *)
type tree = Leaf of leaf | Node of { text : string; ordered : bool; children : tree list }
and leaf = { leaf_text : string; item : Timed.item option; named : int array }

let leaf ?item ?(named = [||]) leaf_text = Leaf { leaf_text; item; named }
let ordered text children = Node { text; ordered = true; children }
let beside text children = Node { text; ordered = false; children }

type spelling = { t : t; label : label -> string; awaited : Timed.item -> bool }

let code s ?(handler = false) text c =
  let skeleton = Skeleton.of_code s.t.skeletons ~handler c in
  leaf ~named:skeleton.pairs (Printf.sprintf "%s%d" text skeleton.number)

let label_of v (p : Core.platform_task) = { name = p.name; vehicle = v; site = p.task_site }

let platform_task s text v (p : Core.platform_task) =
  let label = label_of v p in
  let how : Environment.ending -> _ = function Succeeds -> "s" | May_fail -> "m" | Fails -> "f" in
  let ending = how (Environment.ending s.t.options.environment v p.name) in
  match p.plan, s.t.options.durations.task v None p with
  | None, Within { least; most } -> Printf.sprintf "%s%s%d-%d %s" text ending least most (s.label label)
  | _, _ -> Printf.sprintf "%s%S %S %d %s" text label.name label.vehicle label.site (s.label label)

let rec spell s (r : Residual.t) =
  let item i = if s.awaited i then Some i else None in
  match r with
  | Ready (p, v) -> leaf (platform_task s "t" v p)
  | Running (p, v) -> leaf ?item:(item (Task v)) (platform_task s "T" v p)
  | Action c -> code s "a" c
  | Condition c -> code s "c" c
  | Sequence (a, rest) -> ordered ">" (List.map (spell s) (a :: rest))
  | Parallel rs -> beside "|" (List.map (spell s) rs)
  | All_of (a, bs) -> ordered "all" [ beside "" (List.map (spell s) (Option.to_list a)); branches s bs ]
  | One_of bs -> ordered "one" [ branches s bs ]
  | Until (e, c, a) -> ordered (Value.until e ^ on_cut e) [ code s "" c; spell s a ]
  | Idle { timer; seconds } -> leaf ?item:(item (Timer timer)) (Printf.sprintf "idle%h" seconds)
  | Confirm { question; prompt; _ } ->
    leaf ?item:(item (Question question)) (Printf.sprintf "confirm%d %S" question prompt)
  | During { on_cut = e; timer; duration; started; body } ->
    let time =
      match duration with
      | Seconds x -> leaf ?item:(item (Timer timer)) (Printf.sprintf "%h" x)
      | Given_by c -> code s "" c
    in
    ordered (Printf.sprintf "%s%s%b" (Value.during e) (on_cut e) started) [ time; spell s body ]
  | Watch (a, { code = c; _ }) -> ordered "watch" [ code s ~handler:true "" c; spell s a ]
  | Repeat { round; again = { left; until; each; site = _ } } ->
    let left = Option.fold left ~none:"" ~some:string_of_int in
    let optional f x = beside "" (List.map f (Option.to_list x)) in
    ordered ("repeat" ^ left) [ optional (code s "") until; optional (spell s) round; spell s each ]
  | Made _ | Unallocated _ | Hold _ | Recruit _ | Recruited _ -> invalid_arg "Likeness: a task that is made at its turn"

(* Of each [within] it is said when it is missed, by its place. *)
and on_cut : Core.on_cut -> _ = function Completes -> "" | Fails site -> string_of_int site

and branches s bs =
  beside "" (List.map (fun (b : Residual.branch) -> ordered "?" [ code s "" b.guard; spell s b.body ]) bs)

(* Without what is inert, but for tasks that move their vehicle. *)
let root s inert (r : Residual.t) =
  let is_gone : Residual.t -> bool = function
    | Running (p, v) -> List.mem (Timed.Task v) inert && Durations.moves p = None
    | Idle { timer; _ } -> List.mem (Timed.Timer timer) inert
    | _ -> false
  in
  let components = match r with Parallel rs -> rs | r -> [ r ] in
  beside "|" (List.map (spell s) (List.filter (fun r -> not (is_gone r)) components))

(* {1 Colours} *)

let mix a b = ((a * 0x2545f491) + b + (a lsr 17)) land max_int

type shape = { hash : int; of_leaf : leaf option; is_ordered : bool; shapes : shape list }

let rec shape ~color ~pair tree =
  match tree with
  | Leaf l ->
    let item = Option.fold l.item ~none:0 ~some:color in
    let hash = Array.fold_left (fun h n -> mix h (pair n)) (mix (Hashtbl.hash l.leaf_text) item) l.named in
    { hash; of_leaf = Some l; is_ordered = true; shapes = [] }
  | Node { text; ordered; children } ->
    let shapes = List.map (shape ~color ~pair) children in
    let add h s = if ordered then mix h s.hash else h + mix 7 s.hash in
    { hash = mix 3 (List.fold_left add (Hashtbl.hash text) shapes); of_leaf = None; is_ordered = ordered; shapes }

(* [note n h] is called for each pair [n] that code names, with what is around it. *)
let rec around note at s =
  Option.iter (fun l -> Array.iteri (fun i n -> note n (mix (mix at s.hash) i)) l.named) s.of_leaf;
  let inside i child = around note (mix (mix at s.hash) (if s.is_ordered then i else child.hash)) child in
  List.iteri inside s.shapes

(* Pairs of N, each with its place among those of its key, if that matters. *)
let in_space t tuples =
  let of_key (k, xs) =
    let ordered = Tuples.is_ordered k tuples in
    List.mapi (fun i x -> (Skeleton.pair t.skeletons k x, if ordered then i else 0)) xs
  in
  List.concat_map of_key (Tuples.bindings tuples)

(* Colours of pairs, which tell those apart that play different parts: first by [orbit], then by what is around them. *)
let colours ~color ~orbit pairs space tree =
  let colours = Hashtbl.create 64 in
  List.iter (fun n -> Hashtbl.replace colours n (orbit n)) pairs;
  let pair n = Option.value (Hashtbl.find_opt colours n) ~default:(mix 11 n) in
  let count () = List.length (List.sort_uniq Int.compare (List.map pair pairs)) in
  let rec refine before =
    let found = Hashtbl.create 64 in
    let note n h = Hashtbl.replace found n (h + Option.value (Hashtbl.find_opt found n) ~default:0) in
    around note 1 (shape ~color ~pair tree);
    List.iter (fun (n, place) -> note n (mix 5 place)) space;
    let sum n = Option.value (Hashtbl.find_opt found n) ~default:0 in
    let next = List.map (fun n -> (n, mix (pair n) (sum n land max_int))) pairs in
    List.iter (fun (n, colour) -> Hashtbl.replace colours n colour) next;
    let now = count () in
    if now > before then refine now
  in
  refine (count ());
  pair

(* {1 Texts} *)

type written = { text : string; order : int list; items : Timed.item list }

let rec write ~color ~colored ~pair tree =
  match tree with
  | Leaf { leaf_text; item; named } ->
    let pairs = String.concat "," (List.map pair (Array.to_list named)) in
    let colour = match item with Some i when colored -> Printf.sprintf "^%d" (color i) | Some _ | None -> "" in
    { text = String.concat "" [ leaf_text; "{"; pairs; "}"; colour ]; order = List.map color (Option.to_list item);
      items = Option.to_list item }
  | Node { text; ordered; children } ->
    let compare a b =
      match String.compare a.text b.text with 0 -> Stdlib.compare a.order b.order | order -> order in
    let written = List.map (write ~color ~colored ~pair) children in
    let written = if ordered then written else List.sort compare written in
    { text = String.concat "" [ text; "("; String.concat ";" (List.map (fun w -> w.text) written); ")" ];
      order = List.concat_map (fun w -> w.order) written; items = List.concat_map (fun w -> w.items) written }

let constant t (s : Timed.state) m =
  let shared =
    { s.configuration.shared with allocation = Vehicle_map.empty; tuples = Tuples.empty t.options.program.ordered_keys }
  in
  let key = ({ Configuration.control = Executing (m, Residual.hole); shared }, s) in
  match Constants.find_opt t.constants key with
  | Some n -> n
  | None ->
    let n = Constants.length t.constants in
    Constants.add t.constants key n;
    n

type form = { text : string; items : Timed.item list }

(* [mark] is a pair that is told apart from all others. *)
let form_of t ?mark ~label ~orbit ~pairs ~color ~colored inert (s : Timed.state) m r =
  let inert = List.map (fun (i : Inert.item) -> i.awaited) inert in
  let is_awaited item = List.exists (fun (p : Timed.pending) -> p.item = item) s.pending in
  let awaited item = is_awaited item && not (List.mem item inert) in
  let tree = root { t; label; awaited } inert r in
  let space = in_space t s.configuration.shared.tuples in
  let is_marked n = mark = Some n in
  let colour = colours ~color ~orbit:(fun n -> mix (orbit n) (Bool.to_int (is_marked n))) pairs space tree in
  let compare m n = match Int.compare (colour m) (colour n) with 0 -> Int.compare m n | order -> order in
  let names = Hashtbl.create 64 in
  let name i n = Hashtbl.replace names n (Printf.sprintf "%d#%d%s" (orbit n) i (if is_marked n then "!" else "")) in
  List.iteri name (List.sort compare pairs);
  let pair n = match Hashtbl.find_opt names n with Some name -> name | None -> string_of_int n in
  let written = write ~color ~colored ~pair tree in
  let posted (n, place) = Printf.sprintf "%s@%d" (pair n) place in
  let space = String.concat "," (List.sort String.compare (List.map posted space)) in
  { text = Printf.sprintf "%d %s %s" (constant t s m) space written.text; items = written.items }

let form t e ~color ~colored inert (s : Timed.state) =
  match s.configuration.control with
  | Executing (m, r) ->
    let label l = match Hashtbl.find_opt e.orbits l with Some n -> string_of_int n | None -> "?" in
    let orbit n = Hashtbl.find e.pairs n in
    let pairs = List.of_seq (Hashtbl.to_seq_keys e.pairs) in
    let form = form_of t ~label ~orbit ~pairs ~color ~colored inert s m r in
    { form with text = Printf.sprintf "%d %s" e.number form.text }
  | Script _ | Waiting _ | Ended _ -> invalid_arg "Likeness.form: nothing is executed"

(* {1 Automorphisms} *)

let closures r =
  let of_branch (b : Residual.branch) = (false, b.guard) in
  let add found : Residual.t -> _ = function
    | Action c | Condition c | Until (_, c, _) | During { duration = Given_by c; _ } -> (false, c) :: found
    | Watch (_, { code; _ }) -> (true, code) :: found
    | All_of (_, bs) | One_of bs -> List.map of_branch bs @ found
    | Repeat { again = { until = Some c; _ }; _ } | Made { code = c; _ } | Recruit { code = c; _ } ->
      (false, c) :: found
    | Ready _ | Running _ | Sequence _ | Parallel _ | Idle _ | Confirm _ | During _ | Repeat _ | Unallocated _ | Hold _
    | Recruited _ -> found
  in
  Residual.fold_all add [] r

let labels r =
  let add found : Residual.t -> _ = function
    | Ready (p, v) | Running (p, v) -> label_of v p :: found
    | _ -> found
  in
  List.sort_uniq Stdlib.compare (Residual.fold_all add [] r)

(* The numbers of classes of [xs] with the same [key], each that of its first member, and the members. *)
let classes key xs =
  let by_key = Hashtbl.create 16 and number = Hashtbl.create 16 and members = Hashtbl.create 16 in
  let add i x =
    let key = key x in
    if not (Hashtbl.mem by_key key) then Hashtbl.add by_key key i;
    let n = Hashtbl.find by_key key in
    Hashtbl.replace number x n;
    Hashtbl.replace members n (x :: Option.value (Hashtbl.find_opt members n) ~default:[])
  in
  List.iteri add xs;
  (number, members)

let has_several members = Hashtbl.fold (fun _ xs found -> found || List.length xs > 1) members false

let find_execution t (s : Timed.state) m r =
  let skeletons = List.map (fun (handler, c) -> Skeleton.of_code t.skeletons ~handler c) (closures r) in
  if List.exists (fun (k : Skeleton.t) -> k.unclear) skeletons then None
  else
    let fixed = List.fold_left (fun fixed (k : Skeleton.t) -> Pairs.union fixed k.fixed) Pairs.empty skeletons in
    let is_movable n =
      let pair = (Skeleton.key_of t.skeletons n, Some (Skeleton.value_of t.skeletons n)) in
      not (Pairs.meet (Pairs.singleton pair) fixed)
    in
    let named = List.concat_map (fun (k : Skeleton.t) -> Array.to_list k.pairs) skeletons in
    let pairs = List.filter is_movable (List.sort_uniq Int.compare named) in
    let by_key, _ = classes (Skeleton.key_of t.skeletons) pairs in
    let form ?mark label =
      form_of t ?mark ~label ~orbit:(Hashtbl.find by_key) ~pairs ~color:(fun _ -> 0) ~colored:false [] s m r in
    let is_apart l = if t.apart = Some l.vehicle then "*" else "" in
    let of_label l = (form (fun l' -> (if l = l' then "!" else "") ^ is_apart l')).text in
    let orbits, members = classes of_label (labels r) in
    let pair_orbits, same = classes (fun n -> (form ~mark:n is_apart).text) pairs in
    if has_several members || has_several same then begin
      let renamed = Hashtbl.create 16 in
      let note _ ns = if List.length ns > 1 then List.iter (fun n -> Hashtbl.replace renamed n ()) ns in
      Hashtbl.iter note same;
      Some { number = States.length t.executions; orbits; members; pairs = pair_orbits; renamed }
    end
    else None

let execution t (s : Timed.state) =
  match s.configuration.control with
  | Executing (m, r) when t.possible && not (Residual.makes_tasks r || Residual.may_go_round r) -> (
      match States.find_opt t.executions s with
      | Some found -> found
      | None ->
        let found = find_execution t s m r in
        States.add t.executions s found;
        found)
  | Executing _ | Script _ | Waiting _ | Ended _ -> None

let leaves_alike t e (s : Timed.state) =
  let tuples = s.configuration.shared.tuples in
  let left = List.map fst (in_space t tuples) in
  let of_orbit = Hashtbl.create 16 in
  let is_as_its_orbit n () all =
    let orbit = Hashtbl.find e.pairs n and times = List.length (List.filter (Int.equal n) left) in
    if not (Hashtbl.mem of_orbit orbit) then Hashtbl.add of_orbit orbit times;
    all && times = Hashtbl.find of_orbit orbit
    && (times = 0 || not (Tuples.is_ordered (Skeleton.key_of t.skeletons n) tuples))
  in
  Hashtbl.fold is_as_its_orbit e.renamed true
