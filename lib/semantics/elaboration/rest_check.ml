open Dolphin_syntax
module Ast = Ast

(* The functions of the prelude that go on with their second argument. *)
let of_prelude = [ "withBreaks"; "onlyWhile"; "commanded" ]

let has_prelude ast name =
  let is_it (s : Ast.statement) =
    match s.it with Function f -> f.name.it = name && Location.file s.at = Prelude.file | _ -> false in
  List.exists is_it ast

let plan ast (e : Ast.expression) =
  match e.it with
  | Call { callee = { it = Member { subject; name = { it = "rest"; _ }; _ }; _ }; arguments = [ _ ] } -> Some subject
  | Call { callee = { it = Variable name; _ }; arguments = _ :: Positional p :: _ }
    when List.mem name of_prelude && has_prelude ast name -> Some p
  | _ -> None

let fault constants (e : Ast.expression) =
  match Constants.value (Lazy.force constants) e with
  | Ok (Task (Platform p)) -> (
      match Rest.from_share p 0.5 with
      | Ok _ -> None
      | Error why ->
        Some (Diagnostic.error ~code:No_way e.at why ~hint:"describe it, as in imcPlan { locate ...; goTo() }"))
  | Ok _ | Error _ -> None

let program constants ast =
  let add found e = match plan ast e with Some p -> p :: found | None -> found in
  List.filter_map (fault constants) (List.rev (List.fold_left (Fold.statement add) [] ast))
