open Core
open Checks
open Closures

let check_named_settings env name arguments =
  let allowed = Option.value (List.assoc_opt name Plan_builder.vocabulary) ~default:[] in
  List.iter
    (function
      | Ast.Named (k, _) when not (List.mem k.Ast.it allowed) ->
        error env Unknown_argument k.Ast.at "'%s' has no argument '%s'" name k.Ast.it
          ?hint:(did_you_mean k.Ast.it allowed)
      | Ast.Named _ | Positional _ | Keyed _ -> ())
    arguments

let is_named = function Ast.Named _ | Keyed _ -> true | Positional _ -> false

let add env at slot name arguments =
  let outside f = Scope.inside_settings env.code None f in
  let wants_text = List.mem name [ "id"; "type"; "payload"; "planName"; "description"; "vehicles" ] in
  let argument = function
    | Ast.Positional { Ast.it = Variable _; at } as argument when wants_text ->
      Scope.note_text env.program at;
      elaborate env (value_of argument)
    | Ast.Positional { Ast.it = Wildcard; at } when name = "count" -> constant env at Wildcard
    | argument -> elaborate env (value_of argument)
  in
  let arguments' = outside (fun () -> List.map argument arguments) in
  (match Scope.settings env.code with
   | Some (Imc_plan, _) -> check_named_settings env name arguments
   | Some (Pick, _) when arguments <> [] && not (List.exists is_named arguments) ->
     let literal (e : Ast.expression) = match e.it with Wildcard -> Some Wildcard | _ -> Literal_check.value e in
     let values = List.filter_map literal (List.map value_of arguments) in
     if List.compare_lengths values arguments = 0 then
       Option.iter (fun fault -> error env Wrong_value at "%s" fault) (Literal_check.fault_of_pick name values)
   | Some ((Pick | Pos | All_of | One_of), _) | None ->
     List.iter
       (function
         | Ast.Named (k, _) -> error env Unknown_argument k.Ast.at "'%s' takes no argument by name" name
         | Ast.Positional _ | Keyed _ -> ())
       arguments);
  set_local env at slot
    (apply env at (Add_setting (name, keys_of arguments)) (local env at slot :: arguments'))

let setting env at (name : string Ast.located) e =
  match Scope.settings env.code, in_settings env name.it with
  | _, Some slot -> add env at slot name.it [ Ast.Positional e ]
  | Some (builder, _), None ->
    error env Unknown_setting name.at "%s has no setting '%s'" (builder_name builder) name.it
      ?hint:(did_you_mean name.it (Builtins.settings builder));
    null env at
  | None, None ->
    error env Misplaced_setting name.at "'%s:' stands outside of a block of settings" name.it
      ~hint:(Printf.sprintf "an assignment is %s = ..." name.it);
    null env at

let build env at builder body =
  if builder = Ast.Pick then check_in_script env "pick" at;
  check_repeated env builder body;
  let slot = Scope.new_slot env.code in
  let start = set_local env at slot (constant env at (Settings [])) in
  let body =
    Scope.in_block env.code (fun () ->
        Scope.inside_settings env.code (Some (builder, slot)) (fun () -> statements env at body))
  in
  let name = Printf.sprintf "plan-%d" (Location.line at) in
  block env at [ start; body; apply env at (Build (builder, name)) [ local env at slot ] ]

let when_then env at guard t =
  match Scope.settings env.code with
  | Some ((All_of | One_of), slot) ->
    check_kind env "then" Task t;
    Scope.inside_settings env.code None (fun () ->
        let guard = task_code env at "when" guard in
        let t = task_operand env t in
        set_local env at slot (apply env at Make_branch [ local env at slot; guard; t ]))
  | Some ((Pick | Imc_plan | Pos), _) | None ->
    error env Misplaced_when at "when { ... } then belongs in allOf { ... } or oneOf { ... }"
      ~hint:"a task that waits for one condition is waitFor { ... } then TASK";
    null env at
