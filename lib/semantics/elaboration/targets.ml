open Core
open Checks

(* The target of an assignment: a variable, or an element or member of a target. *)
let rec is_path (e : Ast.expression) =
  match e.it with
  | Variable _ -> true
  | Index (e, _) | Member { subject = e; safe = false; _ } -> is_path e
  | _ -> false

let set_global env at name e = expression env at (Set_global (Scope.assigned_global env.program name, e))

(* Reports a name that no program may assign, though it is not a local. *)
let check_assignable env name name_at =
  if Scope.find_function env.program name <> None then
    error env Not_assignable name_at "'%s' is a function and cannot be assigned" name
  else if Builtins.is_reserved name then
    error env Not_assignable name_at "'%s' is a name of the language and cannot be assigned" name
      ~hint:"choose another name"
  else if Scope.is_parameter env.program name then
    error env Not_assignable name_at "'%s' is a parameter and keeps its value" name
      ~hint:"give what changes another name"

let assign_variable env at name name_at e =
  match Scope.find_local env.code name with
  | Some (Own _) when Scope.has_fields env.code name ->
    error env Not_assignable name_at "'%s' is the error that onError gets, and stays so" name
      ~hint:"choose another name";
    e
  | Some (Own slot) -> set_local env at slot e
  | Some (Captured _) ->
    error env Captured_local name_at
      "'%s' is a local of the code around: a closure has a copy of it and cannot assign it" name
      ~hint:"make it a global variable, without def";
    e
  | None ->
    if env.answer then error env Deed_in_answer name_at "'%s' may not be changed in an answer" name;
    check_assignable env name name_at;
    check_in_maker env ("an assignment to '" ^ name ^ "'") name_at;
    set_global env at name e

(* A variable needs a value before it is changed. *)
let check_given env (target : Ast.expression) =
  match target.it with
  | Variable name
    when in_settings env name = None
      && not (is_hidden env name || Builtins.is_reserved name || Scope.has_first_value env.program name) ->
    error env Unknown_name target.at "'%s' is changed here, and nothing gives it a value before" name
      ~hint:"assign it a first value, such as 0 or []"
  | _ -> ()

let rec assign env at (target : Ast.expression) e =
  match target.it with
  | Variable name -> assign_variable env at name target.at e
  | Index (subject, index) ->
    check_given env subject;
    let slot = Scope.new_slot env.code in
    let keep = set_local env at slot e in
    let current = elaborate env subject in
    let index = elaborate env index in
    let replaced = apply env at Replace_element [ current; index; local env at slot ] in
    block env at [ keep; assign env at subject replaced; local env at slot ]
  | Member { subject; name; _ } ->
    check_given env subject;
    let slot = Scope.new_slot env.code in
    let keep = set_local env at slot e in
    let current = elaborate env subject in
    let replaced = apply env at (Replace_member name.it) [ current; local env at slot ] in
    block env at [ keep; assign env at subject replaced; local env at slot ]
  | _ ->
    error env Not_assignable target.at "this cannot be assigned to"
      ~hint:"assign to a variable, an element or a member";
    e

let update env at target f =
  check_given env target;
  assign env at target (f (elaborate env target))

let increment env at target by prefix =
  let one = constant env at (Integer (abs by)) in
  let op : Ast.binary = if by > 0 then Add else Subtract in
  if prefix then update env at target (fun current -> apply env at (Binary op) [ current; one ])
  else begin
    let slot = Scope.new_slot env.code in
    check_given env target;
    let keep = set_local env at slot (elaborate env target) in
    let added = apply env at (Binary op) [ local env at slot; one ] in
    block env at [ keep; assign env at target added; local env at slot ]
  end
