open Core
open Checks

let make_lambda env at purpose label ~parameters ~implicit body =
  let code = Scope.code env.program purpose (Some env.code) in
  check_parameters env.program parameters;
  let inside = { env with code } in
  List.iter (fun (x : string Ast.located) -> ignore (Scope.define code x.it)) parameters;
  let lambda =
    {
      id = Scope.fresh_lambda_id env.program;
      label;
      parameters = List.length parameters;
      implicit;
      captures = [||];
      slots = 0;
      code = null env at;
      lambda_site = Scope.site env.program at;
    }
  in
  lambda.code <- body inside at;
  lambda.captures <- Array.of_list (List.map snd (Scope.captures code));
  lambda.slots <- Scope.slots code;
  (lambda, List.map fst (Scope.captures code))

let parameters_of at (c : Ast.closure) =
  match c.parameters with Some parameters -> parameters | None -> [ { Ast.it = "it"; at } ]

let closure_of env at purpose label parameters (c : Ast.closure) =
  let implicit = c.parameters = None in
  let body env at = statements env at c.body in
  let lambda, captured = make_lambda env at purpose label ~parameters ~implicit body in
  expression env at (Make_closure (lambda, captured))

let closure env at purpose label c = closure_of env at purpose label (parameters_of at c) c

(* An error has fields: further parameters, that the program cannot name otherwise. *)
let handler env at (c : Ast.closure) =
  let fields (e : string Ast.located) =
    List.map (fun field -> { e with it = Scope.field e.it field }) [ "vehicle"; "task" ]
  in
  let parameters = match parameters_of at c with [] -> [] | e :: _ -> e :: fields e in
  closure_of env at Scope.Handler "onError" parameters c

let conditions = [ "when"; "waitFor"; "until"; "assure"; "condition"; "assert" ]

(* Procedures whose value is null. *)
let without_value = [ "message"; "println"; "post"; "setConnectionTimeout" ]

let task_code env at construct (c : Ast.closure) =
  (match c.parameters with
   | Some (first :: _) -> error env Wrong_parameters first.Ast.at "the code of %s takes no parameters" construct
   | Some [] | None -> ());
  (match List.rev c.body with
   | { it = Assign { target; operator = None; _ }; at } :: _ when List.mem construct conditions ->
     Scope.report env.program
       (Diagnostic.warning Assigned_condition at "this condition assigns, and holds if the value that is assigned does"
          ~hint:(match dotted target with
              | Some name -> Printf.sprintf "to compare, write %s == ..." name
              | None -> "to compare, write =="))
   | { it = Expression { it = Call { callee = { it = Variable name; _ }; _ }; at }; _ } :: _
     when List.mem construct ("repeat" :: conditions) && List.mem name without_value && not (is_hidden env name) ->
     Scope.report env.program
       (Diagnostic.warning Never_holds at (Printf.sprintf "this condition never holds: %s gives no value" name)
          ~hint:"the condition is the last statement of the code, as in { ...; poll go: _ }")
   | _ -> ());
  closure env at (Scope.Task_code construct) construct c

(* The text of code, for messages: on one line. *)
let text_of (c : Ast.closure) =
  let text = Format.asprintf "%a" Dolphin_syntax.Print.program c.body in
  let words = List.filter (( <> ) "") (String.split_on_char ' ' (String.map (function '\n' -> ' ' | c -> c) text)) in
  let text = String.concat " " words in
  if String.length text <= 60 then text else String.sub text 0 57 ^ "..."

let told (c : Ast.closure) code =
  match code.node with
  | Make_closure (lambda, captured) -> { code with node = Make_closure ({ lambda with label = text_of c }, captured) }
  | _ -> code

let told_code env at construct c = told c (task_code env at construct c)

(* {1 confirm} *)

let confirmation env (e : Ast.expression) =
  match e.it with
  | Call { callee = { it = Variable "confirm"; _ }; arguments } when not (is_hidden env "confirm") -> Some arguments
  | _ -> None

(* [confirm 'Q' >> T] is read as [confirm('Q' >> T)]. *)
let prompt_of env at arguments =
  match arguments with
  | [ Ast.Positional ({ it = Binary ((Sequence | Parallel), _, _); _ } as e) ] ->
    error env Wrong_kind e.at "all of this is the prompt of confirm, which is a text"
      ~hint:"put parentheses around the prompt, as in confirm('Retrieve now?') >> T";
    None
  | [ Ast.Positional prompt ] -> check_kind env "confirm" String prompt; Some prompt
  | [ Ast.Named (k, _) ] -> error env Unknown_argument k.at "confirm takes no argument by name"; None
  | arguments ->
    error env Wrong_arity at "confirm takes 1 argument, not %d" (List.length arguments)
      ~hint:"write confirm 'Retrieve now?'";
    None

let confirm_task env at arguments =
  match prompt_of env at arguments with
  | Some prompt -> apply env at (Builtin Make_confirm) [ elaborate env prompt ]
  | None -> null env at

(* {1 Operands} *)

(* Code in the place of a task, also that of certain vehicles. *)
let rec code_of (e : Ast.expression) =
  match e.it with
  | Closure c -> Some c
  | Index (e, _) -> code_of e
  | _ -> None

let check_given env (c : Ast.closure) =
  match c.parameters with
  | Some (x :: _) ->
    error env Wrong_parameters x.at "no guard gives '%s' a value here" x.it
      ~hint:"the values of a guard go to code that is its whole branch: then { x -> T(x) >> U }, or \
             (waitFor { ... } then { x -> T(x) }) >> U"
  | Some [] | None -> ()

(* An operand that is a task; code in its place makes it. *)
let branch_operand env (e : Ast.expression) =
  match e.it, confirmation env e with
  | _, Some arguments -> confirm_task env e.at arguments
  | Closure c, None -> told c (closure env e.at Scope.Maker "task" c)
  | _, None -> elaborate env e

let task_operand env e =
  Option.iter (check_given env) (code_of e);
  branch_operand env e
