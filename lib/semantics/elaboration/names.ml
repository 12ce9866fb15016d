open Core
open Checks

let variable env (name : string) at =
  match Scope.find_local env.code name with
  | Some (Own slot | Captured slot) -> local env at slot
  | None -> (
      match Scope.find_function env.program name with
      | Some lambda -> constant env at (Closure { lambda; captured = [||] })
      | None -> expression env at (Global (Scope.used_global env.program name at)))

let elaborate env name at =
  match in_settings env name with
  | Some slot when not (is_hidden env name) -> Setting_blocks.add env at slot name []
  | Some _ | None ->
    if List.mem name Builtins.owners && not (is_hidden env name) then begin
      error env No_value at "'%s' is not a value by itself" name
        ~hint:(Printf.sprintf "write one of %s"
                 (String.concat ", " (List.filter (fun c -> root c = name) Builtins.constants)));
      null env at
    end
    else if Builtins.find name <> None && not (is_hidden env name || Scope.is_assigned env.program name) then begin
      if Builtins.takes_nothing name then
        error env No_value at "'%s' is a procedure: it needs its parentheses" name
          ~hint:(Printf.sprintf "write %s()" name)
      else
        error env No_value at "'%s' is a procedure: it needs its arguments" name
          ~hint:(Printf.sprintf "write %s(...), or its arguments on the same line" name);
      null env at
    end
    else variable env name at

let member env (whole : Ast.expression) subject (name : string Ast.located) safe =
  let at = whole.at in
  match dotted whole with
  | Some full
    when List.mem (root full) Builtins.owners
      && not (is_hidden env (root full))
      && Option.bind (dotted subject) Builtins.constant = None -> (
      match Builtins.constant full with
      | Some x -> constant env at x
      | None ->
        error env Unknown_name at "unknown name '%s'" full ?hint:(did_you_mean full Builtins.constants);
        null env at)
  | Some _ | None ->
    check_supplier env subject name;
    if List.mem name.it sensor_members then Scope.note_sensor env.program;
    (match kind_of subject with
     | Number when Operators.unit_factor name.it = None ->
       error env Unknown_unit name.at "unknown unit '%s'" name.it ~hint:(Operators.unit_hint name.it)
     | _ -> Member_check.member env ~called:false subject name);
    Chart_calls.check_member env subject name;
    let subject = Checks.elaborate env subject in
    if safe then unless_null env at subject (fun e -> apply env at (Property name.it) [ e ])
    else apply env at (Property name.it) [ subject ]
