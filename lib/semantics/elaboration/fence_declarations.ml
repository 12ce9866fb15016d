open Dolphin_plans
module Ast = Dolphin_syntax.Ast
module Diagnostic = Dolphin_syntax.Diagnostic

let ( let* ) = Result.bind
let word = Checks.fence
let hint = "write fence inside AREA, fence outside AREA, fence depth 30.m, fence height 120.m or fence distance 50.m"
let error ?hint at format = Printf.ksprintf (fun m -> Error [ Diagnostic.error ?hint ~code:Bad_fence at m ]) format

(* {1 One declaration} *)

let kinds = [ "inside"; "outside"; "depth"; "height"; "distance" ]

let area constants kind (e : Ast.expression) =
  let* x = Constants.value constants e in
  match (x : Core.value) with
  | Area area -> Ok area
  | x -> error e.at "fence %s takes an area, not %s" kind (Value.kind x)

(* The areas of a map or a list; [key] is how the text names each. A feature that is neither a place nor a line, but
   not an area either, is flawed: a fence without it would let vehicles in. *)
let areas constants (e : Ast.expression) entries =
  let flaws = Option.fold (Constants.chart constants e) ~none:[] ~some:(fun (chart : Chart.t) -> chart.flawed) in
  let add found ((key : string), (x : Core.value)) =
    let* found = found in
    match x with
    | Area area -> Ok ((key, area) :: found)
    | Position _ | List _ -> Ok found
    | x -> (
        match List.assoc_opt key flaws with
        | Some why -> error e.at "'%s' cannot be part of a fence: %s" key why
        | None -> error e.at "fence outside takes areas, and '%s' is %s" key (Value.kind x))
  in
  let* found = List.fold_left add (Ok []) entries in
  match List.rev found with [] -> error e.at "fence outside takes areas, but has none" | areas -> Ok areas

let in_brackets key =
  Format.asprintf "[%a]" Dolphin_syntax.Print.expression { Ast.it = String key; at = Dolphin_syntax.Location.none }

(* The rules of one declaration, each with the text behind the expression. *)
let outside constants e : ((string * Fences.rule) list, Diagnostic.t list) result =
  let* x = Constants.value constants e in
  let each of_key areas = List.map (fun (key, area) -> (of_key key, Fences.Outside area)) areas in
  match (x : Core.value) with
  | Map entries -> Result.map (each in_brackets) (areas constants e entries)
  | List xs ->
    let numbered = List.mapi (fun i x -> (string_of_int i, x)) (Vector.to_list xs) in
    Result.map (each (Printf.sprintf "[%s]")) (areas constants e numbered)
  | _ -> Result.map (fun area -> [ ("", Fences.Outside area) ]) (area constants "outside" e)

let metres constants what ~least (e : Ast.expression) =
  let* x = Constants.value constants e in
  match Value.to_number x with
  | Some n when Float.is_finite n && n >= least && n <= Dolphin_geo.Wgs84.farthest -> Ok n
  | Some n ->
    error e.at "%s is a number of metres %s, not %.15g" what (if least > 0. then "above 0" else "from 0 on") n
  | None -> error e.at "%s is a number of metres, not %s" what (Value.kind x)

let rule constants kind e : (Fences.rule, Diagnostic.t list) result =
  let above_0 = Float.min_float in
  match kind with
  | "inside" -> Result.map (fun area -> Fences.Inside area) (area constants kind e)
  | "depth" -> Result.map (fun n -> Fences.Depth n) (metres constants "the depth of a fence" ~least:0. e)
  | "height" -> Result.map (fun n -> Fences.Height n) (metres constants "the height of a fence" ~least:0. e)
  | _ -> Result.map (fun n -> Fences.Distance n) (metres constants "the distance of a fence" ~least:above_0 e)

let margin constants kind (arguments : Ast.argument list) =
  match arguments with
  | [] -> Ok 0.
  | [ Named ({ it = "margin"; at }, _) ] when kind = "distance" ->
    error at "fence distance takes no margin: vehicles keep the distance itself"
  | [ Named ({ it = "margin"; _ }, e) ] -> metres constants "the margin of a fence" ~least:0. e
  | Named ({ it = "margin"; _ }, _) :: Named ({ it = "margin"; at }, _) :: _ -> error at "fence has its margin twice"
  | Named (k, _) :: _ when k.it <> "margin" ->
    error k.at "fence has no argument '%s': it has margin" k.it ~hint:"as in fence inside harbour, margin: 20.m"
  | (Positional e | Keyed (_, e) | Named (_, e)) :: _ ->
    error e.at "after a comma, fence takes its margin" ~hint:"as in fence inside harbour, margin: 20.m"

let text kind e key (others : Ast.argument list) =
  let margin = function
    | Ast.Named (_, e) -> Format.asprintf ", margin: %a" Dolphin_syntax.Print.expression e
    | Positional _ | Keyed _ -> ""
  in
  let whole = Format.asprintf "%a" Dolphin_syntax.Print.expression e in
  let shown =
    match e.Ast.it with
    | _ when key = "" -> " " ^ whole
    | Ast.Variable _ | Member _ | Call _ -> " " ^ whole ^ key
    | _ -> Printf.sprintf "((%s)%s)" whole key
  in
  Format.asprintf "%s %s%s%s" word kind shown (String.concat "" (List.map margin others))

let read constants at (arguments : Ast.argument list) =
  let regrouped e = Option.value (Checks.regrouped ~is_procedure:(fun kind -> List.mem kind kinds) e) ~default:e in
  let arguments =
    match arguments with Positional e :: others -> Ast.Positional (regrouped e) :: others | _ -> arguments in
  match arguments with
  | Positional { it = Call { callee = { it = Variable kind; _ }; arguments = [ Positional e ] }; _ } :: others
    when List.mem kind kinds ->
    let* rules =
      if kind = "outside" then outside constants e
      else Result.map (fun rule -> [ ("", rule) ]) (rule constants kind e) in
    let* margin = margin constants kind others in
    Ok (List.map (fun (key, rule) -> { Fences.rule; margin; text = text kind e key others; at }) rules)
  | Positional { it = Call { callee = { it = Variable kind; at }; arguments = _ }; _ } :: _ when List.mem kind kinds ->
    error at "fence %s takes one value" kind ~hint
  | Positional { it = Call { callee = { it = Variable kind; at }; _ }; _ } :: _ -> (
      match Diagnostic.suggest kind kinds with
      | Some near -> error at "unknown fence '%s'" kind ~hint:(Printf.sprintf "did you mean '%s'?" near)
      | None -> error at "unknown fence '%s'" kind ~hint)
  | _ -> error at "fence declares a limit that vehicles must keep" ~hint

(* {1 Programs} *)

let is_own (ast : Ast.program) =
  Assigned.Names.mem word (Assigned.names ast) || List.mem word (Constants.function_names ast)

let declaration (s : Ast.statement) =
  match s.it with
  | Expression { it = Call { callee = { it = Variable name; at }; arguments }; _ } when name = word ->
    Some (at, arguments)
  | Expression { it = Variable name; at } when name = word -> Some (at, [])
  | _ -> None

let is_declaration s = declaration s <> None

let of_program constants ast =
  let add (fences, errors) (at, arguments) =
    match read (Lazy.force constants) at arguments with
    | Ok found -> (List.rev_append found fences, errors)
    | Error found -> (fences, errors @ found)
  in
  match List.fold_left add ([], []) (List.filter_map declaration ast) with
  | fences, [] -> Ok (List.rev fences)
  | _, errors -> Error errors

(* {1 Plans} *)

let plans constants ast =
  let add found (e : Ast.expression) =
    match e.it with
    | Builder ((Imc_plan | Mission), _) -> (
        match Constants.value constants e with
        | Ok (Task (Platform { plan = Some plan; _ })) -> (e, plan) :: found
        | Ok _ | Error _ -> found)
    | _ -> found
  in
  List.rev (List.fold_left (Fold.statement add) [] ast)

(* The statement that is this maneuver, if maneuvers stand in the plan one after the other. *)
let place_of_maneuver (e : Ast.expression) plan maneuver =
  let is_maneuver (s : Ast.statement) =
    match s.it with
    | Expression { it = Call { callee = { it = Variable name; _ }; _ } | Variable name; at } ->
      if Plan_builder.is_maneuver name then Some at else None
    | _ -> None
  in
  let numbered names = List.mapi (fun i name -> (name, i)) names in
  match e.it, plan with
  | Ast.Builder (Imc_plan, body), Inline_plan.Maneuvers p -> (
      let places = List.filter_map is_maneuver body in
      let ids = List.map (fun (m : Plan.maneuver) -> m.id) p.maneuvers in
      match List.assoc_opt maneuver (numbered ids) with
      | Some i when List.compare_lengths places ids = 0 -> List.nth places i
      | Some _ | None -> e.at)
  | _, _ -> e.at

let broken fences plans =
  let error (e, plan) =
    let told (b : Fences.breach) =
      let at = Option.fold b.maneuver ~none:e.Ast.at ~some:(place_of_maneuver e plan) in
      Diagnostic.error ~code:Broken_fence at
        (Printf.sprintf "plan '%s': %s" (Inline_plan.name plan) b.message)
    in
    Option.map told (Fences.of_plan fences ~from:None plan)
  in
  List.filter_map error plans
