open Dolphin_semantics
open Core

exception Too_large

(* Tasks may share parts with themselves, so that they are far larger than their memory. *)
let most_parts = 100_000

(* A renaming that raises is over, so its [depth] is not needed any more. *)
type renaming = { f : vehicle -> vehicle; mutable left : int; mutable depth : int }

let renaming f = { f; left = most_parts; depth = 0 }

let enter r inside =
  r.left <- r.left - 1;
  r.depth <- r.depth + 1;
  if r.left < 0 || r.depth > Value.deepest then raise Too_large;
  let renamed = inside () in
  r.depth <- r.depth - 1;
  renamed

let rec value_by r x =
  enter r @@ fun () ->
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

and task r t =
  enter r @@ fun () ->
  Task.map { part = task r; code = closure r; value = value_by r; vehicle = r.f } t

let residual_by r t =
  let code = closure r in
  let rec part t = Residual.map mapper t
  and mapper =
    { Residual.part; code; handler = code; maker = code; value = value_by r; term = task r; vehicle = r.f }
  in
  part t

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
