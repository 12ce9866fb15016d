open Dolphin_syntax.Ast
module Diagnostic = Dolphin_syntax.Diagnostic

(* [named x] is whether the variable [x] is such a task. *)
let rec is_endless named (e : expression) =
  let go = is_endless named in
  match e.it with
  | Repeat { rounds = None; until = None; _ } -> true
  | Variable x -> named x
  | Binary ((Sequence | Parallel), a, b) -> go a || go b
  | Index (a, _) | Watch (a, _) | Ensure (a, _) | Wait_for (_, a) -> go a
  | _ -> false

(* [execute (a | b) during d] is read as an [execute] with a limit. *)
let rec branches (e : expression) =
  match e.it with
  | Binary (Parallel, a, b) -> branches a @ branches b
  | Call { callee = { it = Variable "execute"; _ }; arguments = [ Positional a ] } -> branches a
  | _ -> [ e ]

let lasts at =
  Diagnostic.warning No_end at "this always lasts the whole time: a repeat beside it has no end of its own"
    ~hint:"race([T, repeat U]) of the prelude ends with T; if it is to last: T during d | (repeat U) during d"

let at_expression named acc (e : expression) =
  match e.it with
  | During (Completes, _, t) ->
    let endless, ending = List.partition (is_endless named) (branches t) in
    if endless <> [] && ending <> [] then lasts (List.hd ending).at :: acc else acc
  | _ -> acc

let program ast =
  let names = Assigned.once (is_endless (fun _ -> false)) ast in
  List.fold_left (Fold.statement (at_expression (fun x -> Assigned.Names.mem x names))) [] ast
