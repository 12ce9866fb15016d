open Dolphin_semantics
open Dolphin_syntax

let rec in_expression found (e : Core.expression) =
  match e.node with
  | Apply (Builtin Platform_task, [ { node = Constant (String name); site } ]) -> (name, site) :: found
  | Make_closure (lambda, _) -> in_expression found lambda.code
  | _ -> List.fold_left in_expression found (Code_walk.parts e)

let of_program (p : Core.program) =
  let codes = List.map (fun (piece : Core.lambda) -> piece.code) (Code_walk.pieces p) in
  List.fold_left in_expression [] codes
  |> List.map (fun (name, site) -> (name, p.locations.(site)))
  |> List.sort_uniq (fun (a, at) (b, at') ->
      compare (at.Location.start.pos_cnum, a) (at'.Location.start.pos_cnum, b))

(* "survey3" is not a misspelling of "survey2". *)
let is_misspelling name near =
  let is_digit c = c >= '0' && c <= '9' in
  let without_digits text = String.to_seq text |> Seq.filter (fun c -> not (is_digit c)) |> String.of_seq in
  without_digits name <> without_digits near

let misspelt p (s : Dolphin_scenario.Scenario.t) =
  let known = List.map (fun (plan : Dolphin_scenario.Scenario.plan) -> plan.name) s.plans in
  let warn (name, at) =
    if List.mem name known then None
    else
      match Diagnostic.suggest name known with
      | Some near when is_misspelling name near ->
        let hint = Printf.sprintf "did you mean '%s'?" near in
        Some (Diagnostic.warning ~hint Unknown_plan at (Printf.sprintf "the fleet does not have plan '%s'" name))
      | Some _ | None -> None
  in
  List.filter_map warn (of_program p)
