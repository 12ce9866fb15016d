open Dolphin_semantics
open Core
module Globals = Set.Make (Int)

module Pairs = struct
  include Set.Make (struct
      type t = string * value option

      (* Of one key, the pair without value comes first. *)
      let compare (k, x) (k', x') =
        match String.compare k k' with 0 -> Option.compare Value.compare x x' | order -> order
    end)

  let has pairs (k, x) =
    mem (k, None) pairs
    ||
    match x with
    | Some _ -> mem (k, x) pairs
    | None -> (
        match find_first_opt (fun (k', _) -> String.compare k' k >= 0) pairs with
        | Some (k', _) -> String.equal k k'
        | None -> false)

  let meet a b = if cardinal a <= cardinal b then exists (has b) a else exists (has a) b
  let meet a b = (not (is_empty a)) && (not (is_empty b)) && meet a b
end

(* Of B. *)
type vehicles = All | These of Vehicle_set.t

let no_vehicles = These Vehicle_set.empty
let is_none = function All -> false | These vs -> Vehicle_set.is_empty vs

let both a b =
  match a, b with All, _ | _, All -> All | These vs, These ws -> These (Vehicle_set.union vs ws)

let common a b =
  match a, b with
  | All, other | other, All -> not (is_none other)
  | These vs, These ws -> not (Vehicle_set.disjoint vs ws)

let all_vehicles = All
let these vs = These (Vehicle_set.of_list vs)

type t = {
  posts : Pairs.t;
  queues : Pairs.t;
  takes : Pairs.t;
  needs : Pairs.t;
  tests : Pairs.t;
  reads : Globals.t;
  writes : Globals.t;
  anything : bool;
  claims : vehicles;
  frees : vehicles;
  looks : bool;
  remembered : bool;
  breaks : bool;
  halts : bool;
  ignores : bool;
}

let empty =
  {
    posts = Pairs.empty;
    queues = Pairs.empty;
    takes = Pairs.empty;
    needs = Pairs.empty;
    tests = Pairs.empty;
    reads = Globals.empty;
    writes = Globals.empty;
    anything = false;
    claims = no_vehicles;
    frees = no_vehicles;
    looks = false;
    remembered = false;
    breaks = false;
    halts = false;
    ignores = false;
  }

let union f f' =
  if f == empty then f'
  else if f' == empty then f
  else
    {
      posts = Pairs.union f.posts f'.posts;
      queues = Pairs.union f.queues f'.queues;
      takes = Pairs.union f.takes f'.takes;
      needs = Pairs.union f.needs f'.needs;
      tests = Pairs.union f.tests f'.tests;
      reads = Globals.union f.reads f'.reads;
      writes = Globals.union f.writes f'.writes;
      anything = f.anything || f'.anything;
      claims = both f.claims f'.claims;
      frees = both f.frees f'.frees;
      looks = f.looks || f'.looks;
      remembered = f.remembered || f'.remembered;
      breaks = f.breaks || f'.breaks;
      halts = f.halts || f'.halts;
      ignores = f.ignores || f'.ignores;
    }

(* Values may hold their parts many times over: larger ones are not looked through. *)
let most_parts = 10_000
let is_small = Value.has_at_most most_parts

(* The value of a pair that matters: none of a queue, where the order of all matters, nor of a value that is large, or
   has a plan in it, which may equal the rest of another value. *)
let told_apart ~ordered x =
  if ordered || (not (is_small x)) || Rest.has_plan x then None else Some (Value.normal x)

let is_ordered (program : Core.program) = Tuple_space.keeps_order program.ordered_keys

let of_posts (program : Core.program) pairs =
  let is_queue = is_ordered program in
  let posts = Pairs.of_list (List.map (fun (k, x) -> (k, told_apart ~ordered:(is_queue k) x)) pairs) in
  { empty with posts; queues = Pairs.filter (fun (k, _) -> is_queue k) posts }

let of_ensured program ds =
  let one f = function
    | Pair (k, x) -> union f (of_posts program [ (k, x) ])
    | Variable (i, _, _) -> { f with writes = Globals.add i f.writes }
    | Taken -> f
  in
  List.fold_left one empty ds

let reads_nothing f =
  Pairs.is_empty f.takes && Pairs.is_empty f.needs && Pairs.is_empty f.tests && Globals.is_empty f.reads
  && not (f.anything || f.looks)

let touches_nothing f =
  reads_nothing f && Pairs.is_empty f.posts && Globals.is_empty f.writes && is_none f.claims && is_none f.frees

let leaves_no_trace f =
  Pairs.is_empty f.posts && Pairs.is_empty f.takes && Globals.is_empty f.writes
  && (not f.anything) && (not f.remembered) && is_none f.claims && is_none f.frees

let share a b = not (Globals.disjoint a b)

let conflict ~possible f f' =
  (not (touches_nothing f || touches_nothing f'))
  && (f.anything || f'.anything
      || Pairs.meet f.queues f'.queues
      || Pairs.meet f.posts f'.tests
      || Pairs.meet f.tests f'.posts
      || Pairs.meet f.takes f'.needs
      || Pairs.meet f.takes f'.tests
      || Pairs.meet f.needs f'.takes
      || Pairs.meet f.tests f'.takes
      || ((not possible) && Pairs.meet f.needs f'.posts)
      || common f.claims f'.claims || common f.claims f'.frees || common f.frees f'.claims
      || share f.reads f'.writes || share f.writes f'.reads || share f.writes f'.writes)

(* {1 Code} *)

type kind = Code | Guard | Maker

module Closures = Hashtbl.Make (struct
    type t = kind * closure

    let equal (kind, c) (kind', c') = kind = kind' && Value.compare_closure c c' = 0
    let hash (kind, c) = (2 * Value.hash_closure c) + Hashtbl.hash kind
  end)

type code = { program : program; known : t Closures.t }

let code program = { program; known = Closures.create 64 }

(* Knowledge about locals: the captured values. Nothing can assign those. *)
type scope = (int * value) list

let rec holds_code = function
  | Closure _ | Settings _ -> true
  | List xs -> Vector.exists holds_code xs
  | Map entries -> List.exists (fun (_, x) -> holds_code x) entries
  | Null | Boolean _ | Integer _ | Number _ | String _ | Wildcard | Symbol _ | Range _ | Position _ | Area _
  | Vehicles _ | Task _ | Host _ | Reading _ | Unknown _ -> false

let holds_code x = (not (is_small x)) || holds_code x

let value (scope : scope) e =
  match e.node with
  | Constant x -> Some x
  | Local slot -> List.assoc_opt slot scope
  | _ -> None

(* Whether the value of an expression surely has no code in it. *)
let rec is_inert (scope : scope) e =
  match e.node with
  | Constant x -> not (holds_code x)
  | Local slot -> (
      match List.assoc_opt slot scope with
      | Some x -> not (holds_code x)
      | None -> false)
  | Apply
      ( Builtin
          ( Post _ | Consume _ | Poll _ | Message | Math _ | Position_of | Sensor_of _ | Is_running | Reading_of | Now
          | Time_of_day | Eta | Is_a _ | Location_of | Area_of | Geometry _ ),
        _ )
  | Apply ((Unary _ | Make_range _ | Concatenate), _) -> true
  | Apply ((Binary _ | Make_list | Make_map _ | Element | Property _ | Method _), arguments) ->
    List.for_all (is_inert scope) arguments
  | _ -> false

(* Whether the value is code that is seen where it is written, or has no code in it. *)
let is_seen scope e =
  match e.node, value scope e with
  | Make_closure _, _ | _, Some (Closure _) -> true
  | _, _ -> is_inert scope e

let breaking = { empty with breaks = true }
let anything = { empty with anything = true; claims = All; looks = true; breaks = true; halts = true; ignores = true }
let all fs = List.fold_left union empty fs

(* With the values' expressions; nothing if a key is computed, and not known. *)
let keyed scope keys arguments =
  let known (k, e) rest =
    match k, rest with
    | _, None -> None
    | Code_walk.Written k, Some rest -> Some ((k, e) :: rest)
    | Computed k, Some rest -> (
        match value scope k with Some (String k) -> Some ((k, e) :: rest) | Some _ | None -> None)
  in
  List.fold_right known (Code_walk.pairs keys arguments) (Some [])

let pairs code scope keys arguments =
  let pair (k, e) =
    match value scope e with
    | Some Wildcard | None -> (k, None)
    | Some x -> (k, told_apart ~ordered:(is_ordered code.program k) x)
  in
  Option.map (fun found -> Pairs.of_list (List.map pair found)) (keyed scope keys arguments)

(* Lists of values of N, whose methods [findAll] and [size] call nothing but their arguments. *)
let rec lists_values e =
  match e.node with
  | Apply (Builtin Values_of, _) -> true
  | Apply (Method ("findAll", _), [ e; { node = Make_closure _; _ } ]) -> lists_values e
  | _ -> false

(* Code that is in the union already, or will be: functions, and closures by identity. *)
type seen = { mutable lambdas : lambda list; mutable closures : closure list }

(* Closures may be nested without end: from here on nothing is known of them. *)
let most_closures = 1_000

let nothing_seen () = { lambdas = []; closures = [] }

let rec expression code scope seen e =
  let of_expression = expression code scope seen in
  match e.node with
  | Constant x -> of_value code seen x
  | Local slot -> Option.fold ~none:empty ~some:(of_value code seen) (List.assoc_opt slot scope)
  | Global i -> { breaking with reads = Globals.singleton i }
  | Set_local (_, e) | Return e -> of_expression e
  | Set_global (i, e) -> union (of_expression e) { empty with writes = Globals.singleton i }
  | Break | Continue -> empty
  | If (a, b, c) -> all [ of_expression a; of_expression b; of_expression c ]
  | Block es -> all (List.map of_expression es)
  | While (a, b) | For (_, a, b) -> all [ breaking; of_expression a; of_expression b ]
  | Make_closure (lambda, _) -> of_lambda code seen lambda
  | Apply (operation, arguments) ->
    union (all (List.map of_expression arguments)) (applied code scope operation arguments)

and of_value code seen = function
  | Closure { lambda; captured = [||] } -> of_lambda code seen lambda
  | Closure c ->
    if List.memq c seen.closures then breaking
    else if List.compare_length_with seen.closures most_closures >= 0 then anything
    else begin
      seen.closures <- c :: seen.closures;
      union breaking (body code seen c)
    end
  | _ -> empty

(* Code that may be called, with anything. *)
and of_lambda code seen lambda =
  if List.memq lambda seen.lambdas then breaking
  else begin
    seen.lambdas <- lambda :: seen.lambdas;
    union breaking (expression code [] seen lambda.code)
  end

and body code seen c = expression code (captured c) seen c.lambda.code
and captured c = List.mapi (fun i slot -> (slot, c.captured.(i))) (Array.to_list c.lambda.captures)

and applied code scope operation arguments =
  let with_pairs keys f = Option.fold ~none:anything ~some:f (pairs code scope keys arguments) in
  match operation, arguments with
  | Builtin (Post []), _ -> anything
  | Builtin (Post keys), arguments ->
    let is_pair e = match value scope e with Some Wildcard | None -> false | Some _ -> true in
    with_pairs keys (fun posts ->
        let queues = Pairs.filter (fun (k, _) -> is_ordered code.program k) posts in
        { empty with posts; queues; breaks = not (List.for_all is_pair arguments) })
  | Builtin (Consume keys), _ -> with_pairs keys (fun pairs -> { empty with takes = pairs; tests = pairs })
  | Builtin (Values_of | Poll []), [ e ] -> (
      match value scope e with
      | Some (String k) -> { empty with tests = Pairs.singleton (k, None) }
      | Some _ | None -> anything)
  | Builtin (Poll keys), _ -> with_pairs keys (fun tests -> { empty with tests })
  | Method (("findAll" | "size"), _), e :: _ when lists_values e -> breaking
  | Builtin Message, [ _ ] -> empty
  | Builtin Make_idle, [ { node = Constant (Integer _ | Number _); _ } ] -> breaking
  | Builtin (Make_idle | Is_running), _ -> { breaking with claims = All; looks = true }
  | Builtin (Halt | Assert), _ -> { empty with halts = true }
  | Builtin (Ignore | Retry), _ -> { breaking with ignores = true }
  | Builtin Dismiss, _ -> { breaking with claims = All; frees = All; looks = true }
  | Builtin Make_watch, [ _; { node = Make_closure (handler, _); _ } ] ->
    { breaking with ignores = Recovery.may_give handler }
  | Call _, callee :: _ -> (
      match callee.node, value scope callee with
      | Make_closure _, _ | _, Some (Closure _) -> breaking
      | _, _ -> anything)
  | (Method _ | Binary Parallel), arguments -> if List.for_all (is_seen scope) arguments then breaking else anything
  | (Concatenate | Make_list), _ -> empty
  | Unary Not, [ _ ] -> empty
  | _, _ -> breaking

(* Guards whose last expression takes or looks for pairs: more pairs do no harm. *)
let rec last code scope e =
  let is_plain f = Pairs.is_empty f.tests && Pairs.is_empty f.takes && not f.anything in
  match e.node with
  | Apply (Builtin (Consume (_ :: _ as keys)), arguments) -> needed code scope keys arguments ~taken:true
  | Apply (Builtin (Poll (_ :: _ as keys)), arguments) -> needed code scope keys arguments ~taken:false
  | Apply (Unary Not, [ { node = Apply (Unary Not, [ e ]); _ } ]) | Return e | Block [ e ] -> last code scope e
  | Block (first :: rest) ->
    let before = expression code scope (nothing_seen ()) first in
    if is_plain before then Option.map (union before) (last code scope { e with node = Block rest }) else None
  | If (a, b, { node = Constant (Boolean false); _ }) -> (
      match last code scope a, last code scope b with
      | Some f, Some f' -> Some (union f f')
      | _, _ -> None)
  | _ ->
    let f = expression code scope (nothing_seen ()) e in
    if is_plain f then Some f else None

and needed code scope keys arguments ~taken =
  let pairs = pairs code scope keys arguments in
  let before = all (List.map (expression code scope (nothing_seen ())) arguments) in
  if Pairs.is_empty before.tests && Pairs.is_empty before.takes && not before.anything then
    Option.map
      (fun pairs -> union before { empty with needs = pairs; takes = (if taken then pairs else Pairs.empty) })
      pairs
  else None

let known code kind c find =
  match Closures.find_opt code.known (kind, c) with
  | Some f -> f
  | None ->
    let f = find () in
    Closures.add code.known (kind, c) f;
    f

let of_code code c = known code Code c (fun () -> body code (nothing_seen ()) c)

let of_guard code c =
  known code Guard c (fun () ->
      match last code (captured c) c.lambda.code with
      | Some f -> f
      | None -> of_code code c)

(* {1 Code that makes tasks} *)

(* Code and locals already visited, or queued: a recursive composition adds nothing. *)
type looked = { mutable lambdas : lambda list; mutable locals : (lambda * int) list }

(* Whether the value of an expression in the place of a task is composed of parts that the program's text shows. *)
let rec is_composed looked (lambda : lambda) e =
  let go = is_composed looked lambda in
  match e.node with
  | Apply (Builtin (Platform_task | Make_action | Make_condition | Make_idle | Make_confirm), _)
  | Apply (Build ((Imc_plan | Mission), _), _) -> true
  (* Values other than tasks: of handlers. *)
  | Constant Null
  | Apply
      (Builtin (Ignore | Propagate | Retry | Dismiss | Fail | Halt | Message | Post _ | Consume _ | Poll _), _) -> true
  | Apply (Builtin (Make_wait_for | Make_until _ | Make_during _), [ _; t ]) -> go t
  | Apply (Builtin Make_fresh, [ c ]) -> go c
  | Apply (Builtin (Make_ensure _), t :: _) -> go t
  | Apply (Builtin Make_watch, [ t; { node = Make_closure (handler, _); _ } ]) ->
    go t && ((not (Recovery.may_give handler)) || gives_composed looked handler)
  | Apply (Element, t :: _) -> go t
  | Apply (Binary (Sequence | Parallel), [ a; b ]) -> go a && go b
  | Apply (Binary Divide, [ t; _ ]) -> go t
  | Make_closure (inner, _) | Constant (Closure { lambda = inner; _ }) -> gives_composed looked inner
  | Apply (Call _, { node = Constant (Closure { lambda = inner; _ }) | Make_closure (inner, _); _ } :: _) ->
    gives_composed looked inner
  | Apply (Build ((All_of | One_of), _), [ { node = Local slot; _ } ]) -> branches_composed looked lambda slot
  | Local slot -> slot >= lambda.parameters && locals_composed looked lambda slot
  | Block es -> ( match List.rev es with last :: _ -> go last | [] -> false)
  | If (_, a, b) -> go a && go b
  | Return _ -> true
  | _ -> false

(* Its value, and whatever it returns. *)
and gives_composed looked (lambda : lambda) =
  List.memq lambda looked.lambdas
  || begin
    looked.lambdas <- lambda :: looked.lambdas;
    let returned e = match e.node with Return e -> is_composed looked lambda e | _ -> true in
    is_composed looked lambda lambda.code && for_all returned lambda.code
  end

and locals_composed looked lambda slot =
  let is_captured = Array.exists (( = ) slot) lambda.captures in
  let assigned e =
    match e.node with
    | Set_local (slot', e) when slot = slot' -> is_composed looked lambda e
    | For (slot', _, _) -> slot <> slot'
    | _ -> true
  in
  List.exists (fun (l, s) -> l == lambda && s = slot) looked.locals
  || begin
    looked.locals <- (lambda, slot) :: looked.locals;
    (not is_captured) && for_all assigned lambda.code
  end

and branches_composed looked lambda slot =
  let added e =
    match e.node with
    | Set_local (slot', { node = Apply (Make_branch, [ _; _; t ]); _ }) when slot = slot' ->
      is_composed looked lambda t
    | _ -> true
  in
  for_all added lambda.code

(* Whether [p] holds of all expressions of one piece of code. *)
and for_all p e = p e && List.for_all (for_all p) (Code_walk.parts e)

(* Code that is seen may be that of a task that fails, or that the outside remembers. *)
let of_maker code c =
  known code Maker c (fun () ->
      let is_seen = gives_composed { lambdas = []; locals = [] } c.lambda in
      if is_seen then { (of_code code c) with breaks = true; remembered = true } else anything)

let claims f = not (is_none f.claims)

let exists_code p (program : program) =
  let found = ref false in
  Code_walk.iter_within (fun within e -> if p within e.node then found := true) (Code_walk.pieces program);
  !found

let all_ensured (program : program) =
  let found = ref None and consumed = ref empty in
  let add f = found := Some (Option.fold !found ~none:f ~some:(union f)) in
  let any_pair k =
    let posts = Pairs.singleton (k, None) in
    { empty with posts; queues = (if is_ordered program k then posts else Pairs.empty) }
  in
  let form = function
    | Pair_of (Some k) -> add (any_pair k)
    | Pair_of None -> add anything
    | Variable_of (i, _) -> add { empty with writes = Globals.singleton i }
    | Taken_pairs -> add empty
  in
  let taken = function Some k -> consumed := union (any_pair k) !consumed | None -> consumed := anything in
  let gives_back = ref false in
  let node _ e =
    match e.node with
    | Apply (Builtin (Make_ensure forms), _) ->
      List.iter form forms;
      if List.mem Taken_pairs forms then gives_back := true
    | Apply (Builtin (Consume keys), _) -> List.iter taken keys
    | _ -> ()
  in
  Code_walk.iter_within node (Code_walk.pieces program);
  if !gives_back then add !consumed;
  !found

let dismisses = exists_code (fun _ -> function Apply (Builtin Dismiss, _) -> true | _ -> false)

let asks_held program =
  let is_number = Numeric.is_number program in
  let asks_idle within = function Apply (Builtin Make_idle, [ e ]) -> not (is_number within e) | _ -> false in
  exists_code asks_idle program || dismisses program || program.asks_running
