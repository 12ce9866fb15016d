open Dolphin_plans
open Core

let unknown_way (p : platform_task) why = Error (Printf.sprintf "the rest of plan '%s' is not known: %s" p.name why)

let described (p : platform_task) =
  match p.plan with
  | None -> unknown_way p "only its vehicle knows its way"
  | Some plan when Inline_plan.way_from plan = None -> unknown_way p "its way depends on the place where it begins"
  | Some plan -> Ok plan

let of_plan p plan = Task (Platform { p with plan = Some plan })

let from_share p share =
  if Float.is_nan share then Error "the share that is done is a number from 0 to 1"
  else Result.map (fun plan -> of_plan p (Inline_plan.from_share share plan)) (described p)

let from_reading p = Result.map (fun plan -> of_plan p (Inline_plan.some_rest plan)) (described p)

(* {1 Which part it is} *)

exception Found

(* Whether [is] holds of a plan in [x], in captured values too; also if [x] has too many parts to look for it. *)
let exists_plan is x =
  let left = ref Value.most_items in
  let one () =
    decr left;
    if !left < 0 then raise Found
  in
  let rec value x =
    one ();
    match x with
    | Task t -> task t
    | Closure c -> code c
    | List xs -> List.iter value (Vector.to_list xs)
    | Map entries -> List.iter (fun (_, x) -> value x) entries
    | Null | Boolean _ | Integer _ | Number _ | String _ | Wildcard | Symbol _ | Range _ | Position _ | Area _
    | Vehicles _ | Host _ | Settings _ | Reading _ | Unknown _ -> ()
  and code c = Array.iter value c.captured
  and task t =
    one ();
    match t with
    | Platform { plan = Some p; _ } -> if is p then raise Found
    | t ->
      let on look x = look x; x in
      ignore (Task.map { part = on task; code = on code; value = on value; vehicle = Fun.id } t : task)
  in
  match value x with () -> false | exception Found -> true

let is_some_rest : Inline_plan.t -> bool = function
  | Rest { share = None; _ } -> true
  | Rest { share = Some _; _ } | Maneuvers _ | Mission _ -> false

let has_some_rest = exists_plan is_some_rest
let has_plan = exists_plan (fun _ -> true)

let rec of_any_part x =
  match x with
  | Task t -> Task (task_of_any_part t)
  | Closure c -> Closure (code_of_any_part c)
  | List xs -> List (Vector.map of_any_part xs)
  | Map entries -> Map (List.map (fun (k, x) -> (k, of_any_part x)) entries)
  | Null | Boolean _ | Integer _ | Number _ | String _ | Wildcard | Symbol _ | Range _ | Position _ | Area _
  | Vehicles _ | Host _ | Settings _ | Reading _ | Unknown _ -> x

and code_of_any_part c = { c with captured = Array.map of_any_part c.captured }

and task_of_any_part = function
  | Platform p -> Platform { p with plan = Option.map Inline_plan.any_part p.plan }
  | t ->
    Task.map { part = task_of_any_part; code = code_of_any_part; value = of_any_part; vehicle = Fun.id } t

let may_equal x y =
  (has_some_rest x || has_some_rest y)
  && (not (Value.has_at_most Value.most_items x && Value.has_at_most Value.most_items y)
      || Value.equals (of_any_part x) (of_any_part y))

let in_doubt at = Fault.make at "this depends on which part of a plan is left, and that is open"

let elements = function List xs -> Vector.to_list xs | _ -> []
let may_contain xs y = List.exists (may_equal y) (elements xs)

let rec some_are_equal = function
  | [] -> false
  | x :: xs -> List.exists (may_equal x) xs || some_are_equal xs

let is_in_doubt operation arguments =
  let is_rest = function Task (Platform { plan = Some p; _ }) -> is_some_rest p | _ -> false in
  match operation, arguments with
  | Binary (Equal | Not_equal), [ x; y ] | Method ("equals", _), [ x; y ] -> may_equal x y
  | Binary Member_of, [ y; xs ] | Method (("contains" | "indexOf" | "removeElement"), _), [ xs; y ] -> may_contain xs y
  | Binary Subtract, [ xs; List ys ] -> Vector.exists (may_contain xs) ys
  | Method ("containsValue", _), [ Map entries; y ] -> List.exists (fun (_, x) -> may_equal x y) entries
  | Method ("unique", _), [ xs ] -> some_are_equal (elements xs)
  (* In their order. *)
  | Method ("sort", _), [ xs ] -> List.exists has_some_rest (elements xs)
  | Property "length", xs | Method (("length" | "getLength" | "duration" | "energy"), _), xs -> List.exists is_rest xs
  | _, _ -> false

(* The share of [plan] itself, perhaps a rest, that is done with [share] of the whole. *)
let of_whole plan ~share =
  match Inline_plan.begun plan with
  | _, Some begun when begun < 1. -> (share -. begun) /. (1. -. begun)
  | _, (Some _ | None) -> 0.

let of_vehicle world (p : platform_task) (s : World.vehicle_state) =
  let rest plan =
    match List.assoc_opt (fst (Inline_plan.begun plan)) s.progress with
    | Some share -> Inline_plan.from_share (of_whole plan ~share) plan
    | None -> plan
  in
  match World.sensor world Progress s with
  | Some (One_of _ | Anything) -> from_reading p
  | Some (Shows _) | None -> Result.map (fun plan -> of_plan p (rest plan)) (described p)
