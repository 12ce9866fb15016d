open Dolphin_syntax
open Ast
module Builtins = Dolphin_semantics.Builtins

type kind =
  | Function of string list
  | Global of expression option
  | Local of expression option
  | Parameter

type span = { start : int; stop : int }

type binding = { name : string; kind : kind; definition : span; uses : span list }

(* A binding being gathered. A global may be used in a function above the line that assigns it. *)
type draft = { of_name : string; mutable defined : (kind * span) option; mutable seen : span list }

type env = {
  source : string;
  drafts : draft list ref;                      (* latest first *)
  globals : (string, draft) Hashtbl.t;
  locals : (string * draft) list;               (* the nearest first *)
  top : bool;                                   (* whether [def] makes a global *)
  settings : string list;                       (* of the block around *)
}

(* The place of the name [x] within [at], which may have parentheses or quotes around it. *)
let span env x (at : Location.t) =
  let n = String.length x and last = min at.stop.pos_cnum (String.length env.source) in
  let rec from i =
    if i + n > last then { start = at.start.pos_cnum; stop = at.stop.pos_cnum }
    else if String.sub env.source i n = x then { start = i; stop = i + n }
    else from (i + 1) in
  from (max 0 at.start.pos_cnum)

let draft env x =
  let made = { of_name = x; defined = None; seen = [] } in
  env.drafts := made :: !(env.drafts);
  made

let global env x =
  match Hashtbl.find_opt env.globals x with
  | Some found -> found
  | None ->
    let made = draft env x in
    Hashtbl.replace env.globals x made;
    made

let see env found x at = found.seen <- span env x at :: found.seen

let define env found kind x at =
  see env found x at;
  if found.defined = None then found.defined <- Some (kind, span env x at)

let local env kind (x : string located) =
  let made = draft env x.it in
  define env made kind x.it x.at;
  { env with locals = (x.it, made) :: env.locals }

let use env x at =
  match List.assoc_opt x env.locals with
  | Some found -> see env found x at
  | None -> see env (global env x) x at

let assign env value x at =
  match List.assoc_opt x env.locals with
  | Some found -> see env found x at
  | None -> define env (global env x) (Global value) x at

(* Procedures whose named arguments have the names of variables. *)
let names_vehicles callee = callee = "execute" || callee = "setConnectionTimeout"

let rec expression env e =
  match e.it with
  | Null | Boolean _ | Integer _ | Number _ | String _ | Wildcard -> ()
  | Variable x -> use env x e.at
  | Template parts -> List.iter (function Literal _ -> () | Hole e -> expression env e) parts
  | List es -> List.iter (expression env) es
  | Map entries ->
    let entry (k, e) =
      (match k.it with Name _ -> () | Computed k -> expression env k);
      expression env e in
    List.iter entry entries
  | Range { first; last; inclusive = _ } -> expression env first; expression env last
  | Closure c -> closure env c
  | Unary (_, e) -> expression env e
  | Binary (_, a, b) | Elvis (a, b) | Index (a, b) -> expression env a; expression env b
  | Conditional (a, b, c) -> expression env a; expression env b; expression env c
  | Increment { target; by = _; prefix = _ } -> target_of env None target
  | Call { callee; arguments } -> call env callee arguments
  | Member { subject; name = _; safe = _ } -> expression env subject
  | Builder (b, body) -> statements { env with settings = Builtins.settings b; top = false } body
  | Pick_else (settings, otherwise) ->
    statements { env with settings = Builtins.settings Pick; top = false } settings;
    block env otherwise
  | Recruit (settings, c) ->
    statements { env with settings = Builtins.settings Recruit; top = false } settings;
    closure env c
  | When (c, e) | Wait_for (c, e) | Until (_, c, e) -> closure env c; expression env e
  | During (_, a, b) -> expression env a; expression env b
  | Watch (e, c) | Ensure (e, c) -> expression env e; closure env c
  | Repeat { rounds; body; until } ->
    Option.iter (expression env) rounds;
    expression env body;
    Option.iter (closure env) until

and call env callee arguments =
  let name = match callee.it with Variable x -> Some x | _ -> None in
  (match name with
   | Some x when arguments <> [] && Builtins.find x <> None -> ()
   | Some x when List.mem x env.settings -> ()
   | Some _ | None -> expression env callee);
  let argument = function
    | Positional e -> expression env e
    | Keyed (k, e) ->
      expression env k;
      expression env e
    | Named (k, e) ->
      if Option.fold name ~none:false ~some:names_vehicles && k.it <> "_" then use env k.it k.at;
      expression env e in
  List.iter argument arguments

and closure env { parameters; body } =
  let env = List.fold_left (fun env x -> local env Parameter x) env (Option.value parameters ~default:[]) in
  statements { env with top = false; settings = [] } body

and target_of env value target =
  match target.it with
  | Variable x -> assign env value x target.at
  | _ -> expression env target

and statements env body = ignore (List.fold_left statement env body)

and block env body = statements { env with top = false } body

(* The environment of the statements after [s]. *)
and statement env s =
  match s.it with
  | Expression e -> expression env e; env
  | Assign { target; operator = _; value } ->
    expression env value;
    target_of env (Some value) target;
    env
  | Define (x, value) ->
    Option.iter (expression env) value;
    if env.top then begin
      assign env value x.it x.at;
      env
    end
    else local env (Local value) x
  | Parameter { name; value; description = _ } ->
    expression env value;
    assign env (Some value) name.it name.at;
    env
  | Function { name; parameters; body } ->
    define env (global env name.it) (Function (List.map (fun x -> x.it) parameters)) name.it name.at;
    let inner = List.fold_left (fun env x -> local env Parameter x) { env with locals = [] } parameters in
    block inner body;
    env
  | If (c, yes, no) -> expression env c; block env yes; block env no; env
  | While (c, body) -> expression env c; block env body; env
  | For (x, e, body) -> expression env e; block (local env Parameter x) body; env
  | Return e -> Option.iter (expression env) e; env
  | Break | Continue -> env
  | Block body -> block env body; env
  | Setting (_, e) -> expression env e; env

let in_order a b = compare a.start b.start

let of_program ~source program =
  let env =
    { source; drafts = ref []; globals = Hashtbl.create 64; locals = []; top = true; settings = [] } in
  statements env program;
  let binding found =
    match found.defined with
    | None -> None
    | Some (kind, definition) ->
      Some { name = found.of_name; kind; definition; uses = List.sort_uniq in_order found.seen } in
  List.sort (fun a b -> in_order a.definition b.definition) (List.filter_map binding !(env.drafts))

let at bindings offset =
  let here span = span.start <= offset && offset <= span.stop in
  List.find_opt (fun b -> List.exists here b.uses) bindings
