module Ast = Dolphin_syntax.Ast
module Include = Dolphin_syntax.Include
open Checks

let word = "map"

let file (e : Ast.expression) =
  match e.it with
  | Call { callee = { it = Variable name; _ }; arguments = [ Positional { it = String path; at } ] }
    when name = word && path <> "" -> Some (Include.beside (Dolphin_syntax.Location.file at) path, at)
  | _ -> None

let defines_function (ast : Ast.program) =
  List.exists (fun (s : Ast.statement) -> match s.it with Function { name; _ } -> name.it = word | _ -> false) ast

let is_own ast = defines_function ast || Assigned.Names.mem word (Assigned.names ast)

let paths ast =
  if is_own ast then []
  else
    let add found e = match file e with Some file -> file :: found | None -> found in
    List.rev (List.fold_left (Fold.statement add) [] ast)

let is_call program name =
  name = word && Scope.find_function program word = None && not (Scope.is_assigned program word)

let assigned ast =
  if is_own ast then []
  else
    let once = Assigned.once (fun e -> file e <> None) ast in
    let of_statement (s : Ast.statement) =
      match s.it with
      | Assign { target = { it = Variable x; _ }; value; _ } | Define ({ it = x; _ }, Some value) ->
        if Assigned.Names.mem x once then Option.map (fun (path, _) -> (x, path)) (file value) else None
      | _ -> None
    in
    List.filter_map of_statement ast

let note program (x, path) =
  match Scope.chart program path with
  | Ok chart -> Scope.note_chart program x path chart
  | Error _ -> ()

let hint = "write map 'harbour.geojson'"

let most_warnings = 10

let warnings at path (chart : Chart.t) =
  let flaw (name, why) = Printf.sprintf "'%s' is null: %s" name why in
  let told = List.map flaw chart.flawed @ chart.notes in
  let warning text = Diagnostic.warning Partial_map at (Printf.sprintf "%s: %s" (Filename.basename path) text) in
  let first = List.filteri (fun i _ -> i < most_warnings) told in
  let further = List.length told - List.length first in
  List.map warning (first @ if further > 0 then [ Printf.sprintf "and %d more like these" further ] else [])

let elaborate env at arguments =
  match arguments with
  | [ Ast.Positional ({ it = String path; at = text_at } : Ast.expression) ] when path <> "" -> (
      match Scope.chart env.program (Include.beside (Dolphin_syntax.Location.file text_at) path) with
      | Ok chart ->
        List.iter (Scope.report env.program) (warnings text_at path chart);
        constant env at chart.value
      | Error why -> error env Bad_map text_at "the map cannot be read: %s" why; null env at)
  | [ Ast.Positional e ] ->
    error env Bad_map e.at "map takes the name of a file, as a text in quotes: it is read before anything runs" ~hint;
    null env at
  | arguments ->
    error env Wrong_arity at "map takes 1 argument, not %d" (List.length arguments) ~hint;
    null env at

let chart_of env (subject : Ast.expression) =
  match subject.it, file subject with
  | Variable x, _ when not (is_hidden env x) -> Scope.find_chart env.program x
  | _, Some (path, _) when is_call env.program word ->
    Option.map (fun chart -> (path, chart)) (Result.to_option (Scope.chart env.program path))
  | _, (Some _ | None) -> None

let check_member env (subject : Ast.expression) (name : string Ast.located) =
  match chart_of env subject with
  | None -> ()
  | Some (path, chart) -> (
      let path = Filename.basename path and names = Chart.names chart in
      match List.assoc_opt name.it chart.flawed with
      | Some why -> error env Bad_map name.at "'%s' of %s cannot be used: %s" name.it path why
      | None ->
        if not (List.mem name.it names) then
          error env Unknown_name name.at "%s has no '%s'" path name.it ?hint:(did_you_mean name.it names))
