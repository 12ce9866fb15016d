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

let negated (e : Ast.expression) : Ast.expression = { e with it = Unary (Negate, e) }

(* [move p, { north 10; west 5 }] is [move p, north: 10, east: -5]. *)
let offset_of (s : Ast.statement) =
  let named (name : string Ast.located) e : Ast.argument option =
    match name.it with
    | "north" | "east" | "up" -> Some (Named (name, e))
    | "south" -> Some (Named ({ name with it = "north" }, negated e))
    | "west" -> Some (Named ({ name with it = "east" }, negated e))
    | "down" -> Some (Named ({ name with it = "up" }, negated e))
    | _ -> None
  in
  match s.it with
  | Setting (name, e) -> named name e
  | Expression { it = Call { callee = { it = Variable it; at }; arguments = [ Positional e ] }; _ } ->
    named { it; at } e
  | _ -> None

let with_offset env (arguments : Ast.argument list) =
  match List.rev arguments with
  | Positional { it = Closure { body; _ }; at } :: before -> (
      let offsets = List.map offset_of body in
      match List.filter_map Fun.id offsets with
      | _ :: _ as named when List.compare_lengths named offsets = 0 -> List.rev before @ named
      | _ ->
        error env Wrong_value at "an offset is north, south, east, west, up or down, each with its metres"
          ~hint:"as in move p, { north 10; east 5 }";
        List.rev before)
  | _ -> arguments

let called arguments =
  List.filter_map
    (function
      | Ast.Positional { Ast.it = Call { callee = { it = Variable name; _ }; _ }; _ } -> Some name
      | Ast.Positional _ | Named _ | Keyed _ -> None)
    arguments

(* "id 'a', 'b'". *)
let hint_for_values name values =
  match name, values with
  | "id", String a :: String b :: _ ->
    Some (Printf.sprintf "a pick names one vehicle: pick { id '%s' } + pick { id '%s' }" a b)
  | _, _ -> None

let add env at slot name arguments =
  let in_mission = match Scope.settings env.code with Some (Mission, _) -> true | Some _ | None -> false in
  let arguments = if in_mission then with_offset env arguments else arguments in
  let outside f = Scope.inside_settings env.code None f in
  let wants_text =
    List.mem name [ "id"; "type"; "payload"; "planName"; "name"; "description"; "vehicles"; "stored" ] in
  let is_setting other = in_settings env other <> None && not (is_hidden env other) in
  let is_setting = Fun.flip List.mem (List.filter is_setting (called arguments)) in
  let argument = function
    | Ast.Positional { Ast.it = Variable _; at } as argument when wants_text ->
      Scope.note_hint env.program ~certain:true at (Printf.sprintf "a text stands in quotes: '%s'");
      elaborate env (value_of argument)
    | Ast.Positional { Ast.it = Call { callee = { it = Variable other; at }; _ }; _ } as argument
      when is_setting other ->
      Scope.note_hint env.program ~certain:true at
        (Printf.sprintf "settings have a ';' or a new line between them: ...; %s ...");
      elaborate env (value_of argument)
    | Ast.Positional { Ast.it = Wildcard; at } when name = "count" -> constant env at Wildcard
    | argument -> elaborate env (value_of argument)
  in
  let arguments' = outside (fun () -> List.map argument arguments) in
  (match in_mission, name, arguments with
   | true, "returnHomeAndLoiter", Positional ({ it = Integer _ | Number _; _ } as e) :: _ ->
     Scope.report env.program
       (Diagnostic.warning Other_meaning e.at
          "this is how long the vehicle loiters, in seconds; in the original language it is the radius"
          ~hint:"write a unit of time behind it, or radius: before it")
   | _, _, _ -> ());
  (match Scope.settings env.code with
   | Some (Imc_plan, _) -> check_named_settings env name arguments
   | Some (Mission, _) ->
     let argument = function
       | Ast.Named (k, e) -> (Some k.Ast.it, e)
       | Positional e | Keyed (_, e) -> (None, e)
     in
     Option.iter
       (fun fault ->
          let hint =
            let about = List.hd (String.split_on_char ' ' fault) in
            if name <> "surveyArea" || List.mem about [ "spacing"; "bearing" ] then None
            else Some "the area is a list of corners: surveyArea [a, b, c], 20.m"
          in
          error env ?hint Wrong_value at "%s" fault)
       (Literal_check.fault_of_mission name (List.map argument arguments))
   | Some ((Pick | Recruit), _) when arguments <> [] && not (List.exists is_named arguments) ->
     let literal (e : Ast.expression) = match e.it with Wildcard -> Some Wildcard | _ -> Literal_check.value e in
     let values = List.filter_map literal (List.map value_of arguments) in
     if List.compare_lengths values arguments = 0 then
       Option.iter (fun fault -> error env ?hint:(hint_for_values name values) Wrong_value at "%s" fault)
         (Literal_check.fault_of_pick name values)
   | Some ((Pick | Recruit | Pos | All_of | One_of), _) | None ->
     List.iter
       (function
         | Ast.Named (k, _) -> error env Unknown_argument k.Ast.at "'%s' takes no argument by name" name
         | Ast.Positional _ | Keyed _ -> ())
       arguments);
  let known_as = if in_mission && name = "name" then "planName" else name in
  set_local env at slot
    (apply env at (Add_setting (known_as, keys_of arguments)) (local env at slot :: arguments'))

let setting env at (name : string Ast.located) e =
  match Scope.settings env.code, in_settings env name.it with
  | _, Some slot -> add env at slot name.it [ Ast.Positional e ]
  | Some (builder, _), None ->
    error env Unknown_setting name.at "%s has no setting '%s'" (builder_name builder) name.it
      ?hint:(hint_for_setting builder name.it);
    null env at
  | None, None ->
    error env Misplaced_setting name.at "'%s:' stands outside of a block of settings" name.it
      ~hint:(Printf.sprintf "an assignment is %s = ..." name.it);
    null env at

let block_of ?(arguments = fun () -> []) env at builder body ~operation =
  if builder = Ast.Pick then check_in_script env "pick" at;
  check_repeated env builder body;
  let slot = Scope.new_slot env.code in
  let start = set_local env at slot (constant env at (Settings [])) in
  let body =
    Scope.in_block env.code (fun () ->
        Scope.inside_settings env.code (Some (builder, slot)) (fun () -> statements env at body))
  in
  block env at [ start; body; apply env at operation (local env at slot :: arguments ()) ]

let build env at builder body =
  block_of env at builder body ~operation:(Build (builder, Printf.sprintf "plan-%d" (Location.line at)))

let pick_if_any env at body = block_of env at Pick body ~operation:Pick_if_any

let recruit env at body (c : Ast.closure) =
  Scope.note_recruit env.program;
  (match c.parameters with
   | Some (_ :: second :: _) ->
     error env Wrong_parameters second.at "the code of recruit takes one parameter, the vehicle"
   | Some ([] | [ _ ]) | None -> ());
  let code () = [ told c (closure env at Scope.Maker "recruit" c) ] in
  block_of env at Recruit body ~operation:Make_recruit ~arguments:code

let when_then env at guard t =
  match Scope.settings env.code with
  | Some ((All_of | One_of), slot) ->
    check_kind env "then" Task t;
    Scope.inside_settings env.code None (fun () ->
        let guard = task_code env at "when" guard in
        let t = Ensures.branch_operand env t in
        set_local env at slot (apply env at Make_branch [ local env at slot; guard; t ]))
  | Some ((Pick | Recruit | Imc_plan | Mission | Pos), _) | None ->
    let hint =
      if Scope.within_branches env.code then
        "branches come from for (x in xs) { when ... } and xs.each { x -> when ... }; other code is a closure"
      else if Scope.in_function env.code then
        "a function makes the task: when { condition } then f(x), or all of allOf { ... }; one that waits is waitFor \
         { condition } then TASK"
      else "a task that waits for one condition is waitFor { ... } then TASK"
    in
    error env ~hint Misplaced_when at "when { ... } then belongs in allOf { ... } or oneOf { ... }";
    null env at
