open Dolphin_semantics
open Core

exception Too_large

(* Tasks may share parts with themselves, so that they are far larger than their memory. *)
let most_parts = 100_000

type renaming = { f : vehicle -> vehicle; mutable left : int }

let renaming f = { f; left = most_parts }

let enter r =
  r.left <- r.left - 1;
  if r.left < 0 then raise Too_large

let rec value_by r x =
  enter r;
  match x with
  | Vehicles vs -> Vehicles (List.map r.f vs)
  | List xs -> List (Vector.map (value_by r) xs)
  | Map entries -> Map (List.map (fun (k, x) -> (k, value_by r x)) entries)
  | Task t -> Task (task r t)
  | Closure c -> Closure (closure r c)
  | Unknown u -> Unknown { u with of_vehicle = r.f u.of_vehicle }
  | Settings settings -> Settings (List.map (setting r) settings)
  | Null | Boolean _ | Integer _ | Number _ | String _ | Wildcard | Symbol _ | Range _ | Position _ | Area _ | Host _
  | Reading _ -> x

and setting r s =
  let positional = List.map (value_by r) s.positional in
  { s with positional; named = List.map (fun (k, x) -> (k, value_by r x)) s.named }

and closure r c = if Array.length c.captured = 0 then c else { c with captured = Array.map (value_by r) c.captured }

and duration r = function Seconds s -> Seconds s | Given_by c -> Given_by (closure r c)

and task r t =
  enter r;
  match t with
  | Platform _ | Idle _ | Confirm _ -> t
  | Action c -> Action (closure r c)
  | Condition c -> Condition (closure r c)
  | Sequence (a, b) ->
    let a = task r a in
    Sequence (a, task r b)
  | Parallel (a, b) ->
    let a = task r a in
    Parallel (a, task r b)
  | Allocated (a, vs) ->
    let vs = List.map r.f vs in
    Allocated (task r a, vs)
  | All_of bs -> All_of (List.map (branch r) bs)
  | One_of bs -> One_of (List.map (branch r) bs)
  | Until (on_cut, c, a) ->
    let c = closure r c in
    Until (on_cut, c, task r a)
  | During (on_cut, d, a) ->
    let d = duration r d in
    During (on_cut, d, task r a)
  | Watch (a, c) ->
    let a = task r a in
    Watch (a, closure r c)
  | Repeat x ->
    let until = Option.map (closure r) x.until in
    Repeat { x with until; body = task r x.body }
  | Made c -> Made (closure r c)
  | Fresh c -> Fresh (closure r c)
  | Recruit x -> Recruit { x with code = closure r x.code }

and branch r b =
  let guard = closure r b.guard in
  { guard; body = task r b.body }

let rec residual_by r (t : Residual.t) : Residual.t =
  let go = residual_by r in
  match t with
  | Ready (p, v) -> Ready (p, r.f v)
  | Running (p, v) -> Running (p, r.f v)
  | Action c -> Action (closure r c)
  | Condition c -> Condition (closure r c)
  | Sequence (a, rest) ->
    let a = go a in
    Sequence (a, List.map go rest)
  | Parallel rs -> Parallel (List.map go rs)
  | All_of (a, bs) ->
    let a = Option.map go a in
    All_of (a, List.map (residual_branch r) bs)
  | One_of bs -> One_of (List.map (residual_branch r) bs)
  | Until (on_cut, c, a) ->
    let c = closure r c in
    Until (on_cut, c, go a)
  | Idle _ | Confirm _ -> t
  | During d ->
    let duration = duration r d.duration in
    During { d with duration; body = go d.body }
  | Watch (a, h) ->
    let a = go a in
    let code = closure r h.code in
    Watch (a, { code; anew = Option.map (fun (t, q) -> (task r t, made r q)) h.anew })
  | Repeat { round; again } ->
    let until = Option.map (closure r) again.until in
    let round = Option.map go round in
    Repeat { round; again = { again with until; each = go again.each } }
  | Made { code; given; request = q } ->
    let code = closure r code in
    Made { code; given = List.map (value_by r) given; request = made r q }
  | Unallocated { task = t; request = q } ->
    let t = task r t in
    Unallocated { task = t; request = made r q }
  | Hold (vs, a) ->
    let vs = List.map r.f vs in
    Hold (vs, go a)
  | Recruit x -> Recruit { x with code = closure r x.code }
  | Recruited (v, a) ->
    let v = r.f v in
    Recruited (v, go a)
  | Fresh (ns, a) -> Fresh (ns, go a)

and made r (q : Residual.request) = { q with allowed = Option.map (List.map r.f) q.allowed }

and residual_branch r (b : Residual.branch) : Residual.branch =
  let guard = closure r b.guard in
  { guard; body = residual_by r b.body }

let items r : Machine.items -> Machine.items = function
  | Items (xs, i) -> Items (Array.map (value_by r) xs, i)
  | Counting _ as counting -> counting

let frame r (frame : Machine.frame) : Machine.frame =
  let values = List.map (value_by r) in
  match frame with
  | Arguments a -> Arguments { a with evaluated = values a.evaluated }
  | Next_item (slot, xs, body) -> Next_item (slot, items r xs, body)
  | Leave locals -> Leave (Array.map (value_by r) locals)
  | Iterate i ->
    let closure = closure r i.closure in
    let subject = value_by r i.subject in
    let items = Array.map (value_by r) i.items in
    Iterate { i with closure; subject; items; gathered = values i.gathered }
  | Assign_local _ | Assign_global _ | Choose _ | Rest _ | Loop_test _ | Loop_body _ -> frame

let machine r (m : Machine.t) : Machine.t =
  let focus : Machine.focus = match m.focus with Give x -> Give (value_by r x) | Evaluate _ as focus -> focus in
  let locals = Array.map (value_by r) m.locals in
  { m with focus; locals; stack = List.map (frame r) m.stack }

let request r : Code.request -> Code.request = function
  | Execute t -> Execute (task r t)
  | Host_call call -> Host_call { call with arguments = Option.map (List.map (value_by r)) call.arguments }
  | (Pick _ | Ask _ | Pause _) as request -> request

let value f x = value_by (renaming f) x
let residual f t = residual_by (renaming f) t

let control f : Configuration.control -> Configuration.control =
  let r = renaming f in
  function
  | Script m -> Script (machine r m)
  | Waiting (m, q) ->
    let m = machine r m in
    Waiting (m, request r q)
  | Executing (m, t) ->
    let m = machine r m in
    Executing (m, residual_by r t)
  | Ended _ as ended -> ended

let tuples (program : program) f ~unordered n =
  let queues, others = List.partition (fun (k, _) -> Tuples.is_ordered k n) (Tuples.bindings n) in
  let rename n (k, xs) = List.fold_left (fun n x -> Tuples.post k (value f x) n) n xs in
  let renamed = List.fold_left rename (Tuples.empty program.ordered_keys) queues in
  unordered ();
  List.fold_left rename renamed others
