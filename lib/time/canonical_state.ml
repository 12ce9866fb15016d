open Dolphin_semantics
open Dolphin_environment
module Footprint = Dolphin_explore.Footprint
module Skeleton = Dolphin_explore.Skeleton
module Pairs = Footprint.Pairs

type label = { name : string; vehicle : Core.vehicle; site : Core.site }

(* Pairs of N that may be renamed, each with its place among them. *)
type pairs = { numbers : int array; places : (int, int) Hashtbl.t }

type execution = {
  number : int;
  orbits : (label, int) Hashtbl.t;
  members : (int, label list) Hashtbl.t;  (* of orbits *)
  pairs : pairs;
  pair_orbits : int array;  (* by place *)
  renamed : int list;  (* the places of pairs that some automorphism renames *)
}

(* The parts that no step of a task changes, by number. *)
module Constants = Hashtbl.Make (struct
    type t = Configuration.t * Clocked.state

    let equal ((c, s) : t) ((c', s') : t) =
      Environment.compare s.outside s'.outside = 0
      && Stdlib.compare (s.elsewhere, s.patience) (s'.elsewhere, s'.patience) = 0
      && Configuration.equal c c'

    let hash ((c, _) : t) = Configuration.hash c
  end)

(* The kind of a part of a residual, without its own parts: code by the number of its skeleton. *)
type head =
  | Task of { runs : bool; ending : Environment.ending; takes : takes; charges : float option; orbit : int }
  | Action of int
  | Condition of int
  | Part of int
  | Sequence
  | Parallel
  | In_order  (* [Parallel] whose parts are cut off in an order that matters *)
  | All_of
  | One_of
  | Branch
  | Some_of
  | Until of Core.on_cut  (* of [cut] *)
  | Seconds of float
  | Confirm of int * string
  | During of Core.on_cut * bool
  | Watch
  | Fresh
  | Repeat of int option
  | Ensure of deed list

(* The value of a pair is a name, as in code. *)
and deed = Posts | Assigns of int * int | Gives_back

and takes = Milliseconds of int * int | As_its_plan of label

module Heads = Dolphin_checker.Interner.Make (struct
    type t = head

    let equal a b = Stdlib.compare a b = 0
    let hash = Hashtbl.hash
  end)

module Values = Dolphin_checker.Interner.Make (struct
    type t = Core.value

    let equal x y = Value.compare x y = 0
    let hash = Value.hash
  end)

type t = {
  options : Clocked.options;
  skeletons : Skeleton.context;
  heads : Heads.t;
  values : Values.t;  (* that are assigned *)
  numbers : Form.numbers;
  unread : string list;  (* keys *)
  constants : int Constants.t;
  executions : execution option Clocked.Table.t;
  apart : Core.vehicle option;  (* it is like no other vehicle *)
  inert : Inert.t;
  possible : bool;
}

let create ?apart (options : Clocked.options) =
  let numbering = Dolphin_checker.Numbering.create () in
  { options; apart; skeletons = Skeleton.context numbering options.program; heads = Heads.create numbering;
    values = Values.create numbering; numbers = Form.numbers numbering; unread = Unread_pairs.keys options.program;
    constants = Constants.create 64; executions = Clocked.Table.create 8; inert = Inert.create options;
    possible = Inert.names_are_free options }

let orbit e label =
  match Hashtbl.find_opt e.orbits label with Some orbit -> List.rev (Hashtbl.find e.members orbit) | None -> [ label ]

(* {1 Residuals as trees} *)

(* Names are pairs of N: their places, or below 0 if they may not be renamed. Items are places in the awaited events. *)
type spelling = {
  t : t;
  orbit : label -> int;
  pairs : pairs;
  awaited : Clocked.item -> bool;
  mutable items : Clocked.item list;  (* latest first *)
}

let place pairs n = Option.value (Hashtbl.find_opt pairs.places n) ~default:(-1 - n)
let tree s ?item ?names ?ordered head parts =
  Form.tree s.t.numbers ?item ?names ?ordered (Heads.number s.t.heads head) parts

let waiting s item head =
  if s.awaited item then begin
    s.items <- item :: s.items;
    tree s ~item:(List.length s.items - 1) head []
  end
  else tree s head []

(* It does not matter which pair is posted that no code reads. *)
let is_read t k = not (List.mem k t.unread)

let is_named t n = is_read t (Skeleton.key_of t.skeletons n)

let code s ?(handler = false) kind c =
  let skeleton = Skeleton.of_code s.t.skeletons ~handler c in
  let named = List.filter (is_named s.t) (Array.to_list skeleton.pairs) in
  tree s ~names:(List.map (place s.pairs) named) (kind skeleton.number) []

let part n = Part n

(* Without the place that comparison leaves out. *)
let cut : Core.on_cut -> Core.on_cut = function Completes _ -> Completes Fault.unknown_site | Fails _ as e -> e

let label_of v (p : Core.platform_task) = { name = p.name; vehicle = v; site = p.task_site }

let platform_task s ~runs v (p : Core.platform_task) =
  let label = label_of v p in
  let takes =
    match p.plan, s.t.options.durations.task v None p with
    | None, Within { least; most } -> Milliseconds (least, most)
    | _, _ -> As_its_plan label
  in
  let charges = s.t.options.durations.charges p.name in
  Task { runs; ending = Environment.ending s.t.options.environment v p.name; takes; charges; orbit = s.orbit label }

(* {2 Ends} *)

let ensured r = Residual.fold_all (fun found -> function Residual.Ensure (ds, _) -> ds @ found | _ -> found) [] r

let is_ordered t = Tuple_space.keeps_order t.options.program.ordered_keys

(* Whether the order of two deeds of ends matters. The pairs that a guard will take are not known. *)
let are_in_order t (d : Core.ensured) (d' : Core.ensured) =
  match d, d' with
  | Variable (i, _, x), Variable (j, _, y) -> i = j && Value.compare x y <> 0
  | Pair (k, x), Pair (k', x') -> String.equal k k' && is_ordered t k && Value.compare x x' <> 0
  | Pair (k, _), Taken | Taken, Pair (k, _) -> is_ordered t k
  | Taken, Taken -> t.options.program.ordered_keys <> Tuple_space.no_key
  | Variable _, (Pair _ | Taken) | (Pair _ | Taken), Variable _ -> false

(* Whether it matters which of [rs], which stand side by side, comes first if a step cuts them off. *)
let order_matters t rs =
  let meets ds ds' = List.exists (fun d -> List.exists (are_in_order t d) ds') ds in
  let rec some_meet = function
    | [] -> false
    | ds :: others -> List.exists (meets ds) others || some_meet others
  in
  some_meet (List.filter (( <> ) []) (List.map ensured rs))

let ensure s ds =
  let deed : Core.ensured -> deed = function
    | Pair _ -> Posts
    | Variable (i, _, x) -> Assigns (i, Values.number s.t.values x)
    | Taken -> Gives_back
  in
  let name : Core.ensured -> _ = function
    | Pair (k, x) when is_read s.t k -> Some (place s.pairs (Skeleton.pair s.t.skeletons k x))
    | Pair _ | Variable _ | Taken -> None
  in
  tree s ~names:(List.filter_map name ds) (Ensure (List.map deed ds))

(* {2 All parts} *)

let rec spell s (r : Residual.t) =
  match r with
  | Ready (p, v) -> tree s (platform_task s ~runs:false v p) []
  | Running (p, v) -> waiting s (Task v) (platform_task s ~runs:true v p)
  | Action c -> code s (fun n -> Action n) c
  | Condition c -> code s (fun n -> Condition n) c
  | Sequence (a, rest) -> tree s Sequence (List.map (spell s) (a :: rest))
  | Parallel bs -> beside s (Branches.to_list bs)
  | All_of (a, bs) -> tree s All_of [ optional s (spell s) a; branches s bs ]
  | One_of bs -> tree s One_of [ branches s bs ]
  | Until (e, c, a) -> tree s (Until (cut e)) [ code s part c; spell s a ]
  | Idle { timer; seconds; site = _ } -> waiting s (Timer timer) (Seconds seconds)
  | Confirm { question; prompt; _ } -> waiting s (Question question) (Confirm (question, prompt))
  | During { on_cut; timer; duration; started; body } ->
    let time =
      match duration with Seconds x -> waiting s (Timer timer) (Seconds x) | Given_by c -> code s part c in
    tree s (During (cut on_cut, started)) [ time; spell s body ]
  | Watch (a, { code = c; _ }) -> tree s Watch [ code s ~handler:true part c; spell s a ]
  | Repeat { round; again = { left; until; each; site = _ } } ->
    tree s (Repeat left) [ optional s (code s part) until; optional s (spell s) round; spell s each ]
  | Fresh (_, a) -> tree s Fresh [ spell s a ]
  | Made _ | Unallocated _ | Hold _ | Recruit _ | Recruited _ ->
    invalid_arg "Canonical_state: a task that is made at its turn"
  | Ensure (ds, a) -> ensure s ds [ spell s a ]

and beside s rs =
  let parts = List.map (spell s) rs in
  if order_matters s.t rs then tree s In_order parts else tree s ~ordered:false Parallel parts

and optional : 'a. spelling -> ('a -> Form.tree) -> 'a option -> Form.tree =
  fun s spelled x -> tree s Some_of (List.map spelled (Option.to_list x))

and branches s bs =
  let branch (b : Residual.branch) = tree s Branch [ code s part b.guard; spell s b.body ] in
  tree s ~ordered:false Some_of (List.map branch bs)

(* Without what is inert, but for tasks that move their vehicle. *)
let root s ~is_inert (r : Residual.t) =
  let moves found : Residual.leaf -> bool = function Plan (p, _) -> found || Durations.moves p | _ -> found in
  let is_gone r =
    Option.fold (Inert.awaited r) ~none:false ~some:is_inert && not (Residual.fold_leaves moves false r) in
  let components = match r with Parallel bs -> Branches.to_list bs | r -> [ r ] in
  beside s (List.filter (fun r -> not (is_gone r)) components)

(* Pairs of N, each with its place among those of its key, if that matters. *)
let in_space t pairs tuples =
  let of_key (k, xs) =
    let ordered = Tuples.is_ordered k tuples in
    List.mapi (fun i x -> (place pairs (Skeleton.pair t.skeletons k x), if ordered then i else 0)) xs
  in
  List.concat_map of_key (Tuples.bindings tuples)

let constant t (s : Clocked.state) m =
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

type parts = { tree : Form.tree; awaited : Clocked.item array; placed : (int * int) list; constant : int }
type spelled = { likeness : t; execution : execution; parts : parts }

let parts t ~orbit ~pairs inert (state : Clocked.state) m r =
  let table items =
    let table = Hashtbl.create 16 in
    List.iter (fun (item : Clocked.item) -> Hashtbl.replace table item ()) items;
    Hashtbl.mem table
  in
  let is_inert = table (List.map (fun (i : Inert.item) -> i.awaited) inert) in
  let is_awaited = table (List.map (fun (p : Clocked.pending) -> p.item) state.pending) in
  let awaited item = is_awaited item && not (is_inert item) in
  let s = { t; orbit; pairs; awaited; items = [] } in
  let tree = root s ~is_inert r in
  { tree; awaited = Array.of_list (List.rev s.items); placed = in_space t pairs state.configuration.shared.tuples;
    constant = constant t state m }

let spell t e inert (s : Clocked.state) =
  match s.configuration.control with
  | Executing (m, r) ->
    let orbit l = Option.value (Hashtbl.find_opt e.orbits l) ~default:(-1) in
    { likeness = t; execution = e; parts = parts t ~orbit ~pairs:e.pairs inert s m (Inert.handled t.inert r) }
  | Script _ | Waiting _ | Ended _ -> invalid_arg "Canonical_state.spell: nothing is executed"

let execution_of spelled = spelled.execution

type form = { number : int; items : Clocked.item list }

let form ~color ~colored { likeness; execution; parts = { tree; awaited; placed; constant } } =
  let { Form.number; items } =
    Form.make likeness.numbers ~orbits:execution.pair_orbits ~colors:(Array.map color awaited) ~colored ~placed
      [ constant; execution.number ] tree
  in
  { number; items = List.map (fun i -> awaited.(i)) items }

(* {1 Automorphisms} *)

let closures =
  Residual.fold_leaves (fun found -> function
      | Code c | Maker c -> (false, c) :: found
      | Handler c -> (true, c) :: found
      | Plan _ | Given _ | Term _ | Held _ | Timer _ -> found) []

let posted t r =
  let pair : Core.ensured -> _ = function
    | Pair (k, x) when is_read t k -> Some (k, x)
    | Pair _ | Variable _ | Taken -> None
  in
  List.filter_map pair (ensured r)

let labels r =
  let add found : Residual.leaf -> _ = function Plan (p, v) -> label_of v p :: found | _ -> found in
  List.sort_uniq Stdlib.compare (Residual.fold_leaves add [] r)

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

let find_execution ~tick t (s : Clocked.state) m r =
  let skeletons = List.map (fun (handler, c) -> Skeleton.of_code t.skeletons ~handler c) (closures r) in
  if List.exists (fun (k : Skeleton.t) -> k.unclear) skeletons then None
  else
    let fixed = List.fold_left (fun fixed (k : Skeleton.t) -> Pairs.union fixed k.fixed) Pairs.empty skeletons in
    let by_name, others = List.partition (fun (_, x) -> Skeleton.may_be_named x) (posted t r) in
    let fixed = List.fold_left (fun fixed (k, _) -> Pairs.add (k, None) fixed) fixed others in
    let is_movable n =
      let pair = (Skeleton.key_of t.skeletons n, Some (Skeleton.value_of t.skeletons n)) in
      not (Pairs.meet (Pairs.singleton pair) fixed)
    in
    let of_code = List.concat_map (fun (k : Skeleton.t) -> Array.to_list k.pairs) skeletons in
    let named =
      List.map (fun (k, x) -> Skeleton.pair t.skeletons k x) by_name @ List.filter (is_named t) of_code
    in
    let numbers = List.filter is_movable (List.sort_uniq Int.compare named) in
    let pairs = { numbers = Array.of_list numbers; places = Hashtbl.create 16 } in
    Array.iteri (fun place n -> Hashtbl.replace pairs.places n place) pairs.numbers;
    let by_key, _ = classes (Skeleton.key_of t.skeletons) numbers in
    let by_key = Array.map (Hashtbl.find by_key) pairs.numbers in
    let form orbits orbit =
      tick ();
      let { tree; awaited; placed; constant = _ } = parts t ~orbit ~pairs [] s m r in
      let colors = Array.map (fun _ -> 0) awaited in
      (Form.make t.numbers ~orbits ~colors ~colored:false ~placed [] tree).number
    in
    let is_apart l = Bool.to_int (t.apart = Some l.vehicle) in
    let of_label l = form by_key (fun l' -> (2 * Bool.to_int (l = l')) + is_apart l') in
    let orbits, members = classes of_label (labels r) in
    let places = List.mapi (fun place _ -> place) numbers in
    (* A pair that is distinguished from all others has an orbit of its own. *)
    let apart place p orbit = if p = place then orbit + Array.length by_key else orbit in
    let of_place place = form (Array.mapi (apart place) by_key) is_apart in
    let pair_orbits, same = classes of_place places in
    if has_several members || has_several same then
      let renamed = Hashtbl.fold (fun _ places all -> if List.length places > 1 then places @ all else all) same [] in
      let pair_orbits = Array.of_list (List.map (Hashtbl.find pair_orbits) places) in
      Some { number = Clocked.Table.length t.executions; orbits; members; pairs; pair_orbits; renamed }
    else None

let execution ~tick t (s : Clocked.state) =
  match s.configuration.control with
  | Executing (m, r) when t.possible -> (
      match Clocked.Table.find_opt t.executions s with
      | Some found -> found
      | None ->
        let r = Inert.handled t.inert r in
        let has_other_tasks = Residual.makes_tasks r || Residual.may_go_round r in
        let found = if has_other_tasks then None else find_execution ~tick t s m r in
        Clocked.Table.add t.executions s found;
        found)
  | Executing _ | Script _ | Waiting _ | Ended _ -> None

let leaves_alike t e (s : Clocked.state) =
  let tuples = s.configuration.shared.tuples in
  let times = Array.map (fun _ -> 0) e.pair_orbits in
  List.iter (fun (n, _) -> if n >= 0 then times.(n) <- times.(n) + 1) (in_space t e.pairs tuples);
  let of_orbit = Hashtbl.create 16 in
  let is_as_its_orbit n =
    let orbit = e.pair_orbits.(n) in
    if not (Hashtbl.mem of_orbit orbit) then Hashtbl.add of_orbit orbit times.(n);
    times.(n) = Hashtbl.find of_orbit orbit
    && (times.(n) = 0 || not (Tuples.is_ordered (Skeleton.key_of t.skeletons e.pairs.numbers.(n)) tuples))
  in
  List.for_all is_as_its_orbit e.renamed
