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

let depends_on_way = function
  | Binary (Equal | Not_equal | Member_of) | Property "length" | Builtin (Consume _ | Poll _) -> true
  | Method (name, _) ->
    List.mem name
      [ "length"; "getLength"; "duration"; "energy"; "equals"; "contains"; "containsValue"; "indexOf"; "unique";
        "removeElement" ]
  | _ -> false

let is_some_rest = function Task (Platform { plan = Some (Rest { share = None; _ }); _ }) -> true | _ -> false

let is_in_doubt operation arguments =
  let has_some_rest x = is_some_rest x || match x with List xs -> Vector.exists is_some_rest xs | _ -> false in
  depends_on_way operation && List.exists has_some_rest arguments

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
