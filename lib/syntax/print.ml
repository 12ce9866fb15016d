open Ast
open Spelling

(* {1 Layout} *)

(* Whether braces with [body] fit on one line: few simple statements. *)
let is_short body =
  let simple s =
    match s.it with
    | Expression _ | Assign _ | Define _ | Parameter _ | Return _ | Break | Continue | Setting _ -> true
    | Function _ | If _ | While _ | For _ | Block _ -> false
  in
  let rec within budget = function
    | [] -> true
    | _ when budget = 0 -> false
    | Well_formed.Statement_node s :: _ when not (simple s) -> false
    | node :: rest -> within (budget - 1) (List.rev_append (Well_formed.children node) rest)
  in
  List.compare_length_with body 4 < 0 && within 24 (List.map (fun s -> Well_formed.Statement_node s) body)

let width = 100
let tab = 4

(* A name that may stand before a brace or an argument, and be called by that. *)
let is_plain name = Layout.builder name = None && not (Foreign.is_word name)

let is_closure = function
  | Positional { it = Closure _; _ } -> true
  | Positional _ | Named _ | Keyed _ -> false

(* Whether [e] is spelt with a call at its start, of a name with one argument. *)
let rec begins_with_call e =
  match e.it with
  | Call { callee = { it = Variable name; _ }; arguments = [ Positional _ ] } -> is_plain name
  | Binary (_, e, _) | Index (e, _) | Member { subject = e; _ } | Call { callee = e; _ } -> begins_with_call e
  | _ -> false

(* Whether [e] is such a call with limits around it, each of which can stand behind it. *)
let rec is_limited_call e =
  match e.it with
  | During (_, d, e) -> (not (is_closure (Positional d))) && is_limited_call e
  | Until (_, _, e) | Ensure (e, _) -> is_limited_call e
  | _ -> begins_with_call e

(* Whether [e] is spelt, at this level, with such a call and a limit behind it at its start. *)
let rec begins_with_limit level e =
  match e.it with
  | Binary (o, e, _) -> level_of_operator o >= level && begins_with_limit (level_of_operator o) e
  | During _ | Until _ | Ensure _ -> is_limited_call e
  | _ -> false

(* The arguments between parentheses, and the closure after them. *)
let split_trailing callee arguments =
  let may_trail =
    match callee.it with
    | Variable name -> is_plain name
    | Member _ | Index _ -> true
    | _ -> false
  in
  match List.rev arguments with
  | Positional ({ it = Closure _; _ } as closure) :: reversed
    when may_trail && not (List.exists is_closure reversed) -> List.rev reversed, Some closure
  | _ -> arguments, None

(* Whether [e] is spelt with a [-] at its start. *)
let rec starts_with_minus e =
  match e.it with
  | Unary (Negate, _) | Increment { by = -1; prefix = true; _ } -> true
  | Binary (_, e, _) -> starts_with_minus e
  | Integer n -> n < 0
  | Number x -> x < 0.
  | _ -> false

(* Whether a comma behind [e] would belong to a [repeat] at its end. *)
let rec takes_comma e =
  match e.it with
  | Repeat { rounds = None; _ } -> true
  | Repeat { rounds = Some _; body = t; until = None } | When (_, t) | Wait_for (_, t) | Until (_, _, t)
  | During (_, _, t) -> takes_comma t
  | _ -> false

(* Whether [e] is spelt with an [ensure] at its end. *)
let rec ends_with_ensure e =
  match e.it with
  | Ensure _ -> true
  | Binary (_, _, e) | Unary (_, e) | Elvis (_, e) | Conditional (_, _, e) | Range { last = e; _ } | When (_, e)
  | Wait_for (_, e) | Until (_, _, e) | During (_, _, e) | Repeat { body = e; until = None; _ } -> ends_with_ensure e
  | _ -> false

let value_of = function Positional e | Named (_, e) | Keyed (_, e) -> e

(* Whether a call without parentheses would have the [ensure] at the end of its last argument, as [f a ensure { }] is
   [f(a) ensure { }]. It belongs to the task in [execute t ensure { }]. *)
let takes_ensure name arguments =
  name <> "execute" && ends_with_ensure (value_of (List.nth arguments (List.length arguments - 1)))

(* Whether [e] is spelt with a brace at its start. *)
let rec starts_with_brace e =
  match e.it with
  | Closure _ -> true
  | Binary (_, e, _) | Conditional (e, _, _) | Elvis (e, _) | Range { first = e; _ } | Index (e, _)
  | Member { subject = e; _ } | Call { callee = e; _ } | Increment { target = e; prefix = false; _ }
  | Ensure (e, _) ->
    starts_with_brace e
  | _ -> false

let is_block s =
  match s.it with
  | Block _ -> true
  | Function _ | Expression _ | Assign _ | Define _ | Parameter _ | If _ | While _ | For _ | Return _ | Break | Continue
  | Setting _ -> false

type out = { buffer : Buffer.t; indent : int }

let put out text = Buffer.add_string out.buffer text
let inner out = { out with indent = out.indent + tab }

let line out =
  put out "\n";
  put out (String.make out.indent ' ')

(* Whether what is out so far ends with the name of a builder, to which a brace on the next line would belong. *)
let ends_with_builder out =
  let length = Buffer.length out.buffer in
  let ends word =
    let n = String.length word in
    length >= n && Buffer.sub out.buffer (length - n) n = word in
  List.exists ends [ "pick"; "imcPlan"; "mission"; "pos"; "allOf"; "oneOf"; "choose"; "recruit" ]

(* The text between a statement and the next, before the end of the line. *)
let finish_before out next = if is_block next && ends_with_builder out then put out ";"

let rec separated out separator print = function
  | [] -> ()
  | [ x ] -> print x
  | x :: rest ->
    print x;
    put out separator;
    separated out separator print rest

(* {1 Expressions} *)

let rec expression out asked e =
  if level e >= asked then bare out e
  else begin
    put out "(";
    bare out e;
    put out ")"
  end

and bare out e =
  match e.it with
  | Null -> put out "null"
  | Boolean b -> put out (string_of_bool b)
  | Integer n -> put out (string_of_int n)
  | Number x -> put out (decimal x)
  | String text -> put out (quoted text)
  | Template parts ->
    put out "\"";
    List.iter (part out) parts;
    put out "\""
  | Variable name -> put out name
  | Wildcard -> put out "_"
  | List es ->
    put out "[";
    separated out ", " (element out) es;
    put out "]"
  | Map [] -> put out "[:]"
  | Map entries ->
    put out "[";
    separated out ", " (entry out) entries;
    put out "]"
  | Range { first; last; inclusive } ->
    binary out range first (if inclusive then ".." else "..<") last
  | Closure c -> closure out c
  | Unary (Not, e) ->
    put out "!";
    expression out unary e
  | Unary (Negate, e) ->
    put out "-";
    expression out (if starts_with_minus e then postfix else unary) e
  | Binary (o, a, b) -> binary out (level_of_operator o) a (" " ^ operator o ^ " ") b
  | Conditional (c, a, b) ->
    expression out (conditional + 1) c;
    put out " ? ";
    expression out conditional a;
    put out " : ";
    expression out conditional b
  | Elvis (a, b) ->
    expression out (conditional + 1) a;
    put out " ?: ";
    expression out conditional b
  | Increment { target; by; prefix } ->
    let sign = if by > 0 then "++" else "--" in
    if prefix then put out sign;
    expression out postfix target;
    if not prefix then put out sign
  | Call { callee; arguments } -> call out callee arguments
  | Member { subject; name; safe } ->
    expression out postfix subject;
    put out (if safe then "?." else ".");
    put out name.it
  | Index (e, i) ->
    expression out postfix e;
    put out "[";
    expression out whole i;
    put out "]"
  | Builder (b, body) ->
    put out (builder b);
    put out " ";
    braces out "" body
  | Pick_else (settings, otherwise) ->
    put out (builder Pick);
    put out " ";
    braces out "" settings;
    put out " else ";
    braces out "" otherwise
  | Recruit (settings, c) ->
    put out (builder Recruit);
    put out " ";
    braces out "" settings;
    put out " then ";
    closure out c
  | When (c, t) -> guarded out "when" c "then" t
  | Wait_for (c, t) -> guarded out "waitFor" c "then" t
  | Until (on_cut, c, t) -> guarded out (until on_cut) c "run" t
  | During (on_cut, d, t) ->
    put out (during on_cut);
    put out " ";
    expression out conditional d;
    put out " run ";
    expression out whole t
  | Watch (t, c) ->
    put out "watch ";
    expression out conditional t;
    put out " onError ";
    closure out c
  | Ensure (t, c) ->
    expression out postfix t;
    put out " ensure ";
    closure out c
  | Repeat { rounds; body; until = condition } ->
    let first n = expression out conditional n; put out ", " in
    let last c = put out (" " ^ until Completes ^ " "); closure out c in
    put out "repeat ";
    Option.iter first rounds;
    expression out (if condition = None then whole else conditional) body;
    Option.iter last condition

and binary out level a operator b =
  expression out level a;
  put out operator;
  expression out (level + 1) b

and guarded out word c joint t =
  put out word;
  put out " ";
  closure out c;
  put out (" " ^ joint ^ " ");
  expression out whole t

and part out = function
  | Literal text -> put out (escaped ~quote:'"' text)
  | Hole e ->
    put out "${";
    expression out whole e;
    put out "}"

and entry out (key, e) =
  begin match key.it with
    | Name name -> put out (key_name name)
    | Computed ({ it = Integer n; _ } as k) when n >= 0 -> bare out k
    | Computed k ->
      put out "(";
      bare out k;
      put out ")"
  end;
  put out ": ";
  element out e

and argument out = function
  | Positional e -> element out e
  | Named (name, e) ->
    put out (key_name name.it);
    put out ": ";
    element out e
  | Keyed (k, e) ->
    put out "(";
    bare out k;
    put out "): ";
    element out e

(* A comma may follow. *)
and element out e = expression out (if takes_comma e then whole + 1 else whole) e

and call out callee arguments =
  expression out postfix callee;
  let enclosed, trailing = split_trailing callee arguments in
  if enclosed <> [] || trailing = None then begin
    put out "(";
    separated out ", " (argument out) enclosed;
    put out ")"
  end;
  Option.iter (fun closure -> put out " "; bare out closure) trailing

and closure out { parameters; body } =
  let head =
    match parameters with
    | None -> ""
    | Some [] -> "->"
    | Some names -> String.concat ", " (List.map (fun name -> name.it) names) ^ " ->"
  in
  braces out head body

and braces out head body =
  put out "{";
  if head <> "" then put out (" " ^ head);
  if body = [] then put out " }"
  else if is_short body then begin
    put out " ";
    separated out "; " (statement out) body;
    put out " }"
  end
  else block out body

(* Statements on lines of their own, and the closing brace. *)
and block out body =
  let within = inner out in
  List.iter (fun s -> finish_before out s; line within; statement within s) body;
  line out;
  put out "}"

(* {1 Statements} *)

and body out statements =
  if statements = [] then put out "{ }"
  else begin
    put out "{";
    block out statements
  end

and statement out s =
  match s.it with
  | Expression { it = Call { callee = { it = Variable name; _ }; arguments = _ :: _ as arguments }; _ }
    when is_plain name && not (List.compare_length_with arguments 1 = 0 && List.exists is_closure arguments) ->
    command out name arguments
  | Expression e -> limited out e
  | Assign { target; operator = o; value } ->
    opening out target;
    put out (Printf.sprintf " %s= " (Option.fold o ~none:"" ~some:operator));
    expression out whole value
  | Define (name, None) -> put out ("def " ^ name.it)
  | Define (name, Some e) ->
    put out (Printf.sprintf "def %s = " name.it);
    expression out whole e
  | Function { name; parameters; body = statements } ->
    let parameters = List.map (fun name -> name.it) parameters in
    put out (Printf.sprintf "def %s(%s) " name.it (String.concat ", " parameters));
    body out statements
  | Parameter { name; value; description } ->
    put out (Printf.sprintf "parameter %s = " name.it);
    element out value;
    Option.iter (fun text -> put out ", "; expression out whole { it = String text.it; at = text.at }) description
  | If (condition, yes, no) -> conditional_statement out condition yes no
  | While (condition, statements) ->
    put out "while (";
    expression out whole condition;
    put out ") ";
    body out statements
  | For (name, e, statements) ->
    put out (Printf.sprintf "for (%s in " name.it);
    expression out whole e;
    put out ") ";
    body out statements
  | Return None -> put out "return"
  | Return (Some e) ->
    put out "return ";
    expression out whole e
  | Break -> put out "break"
  | Continue -> put out "continue"
  | Block statements -> body out statements
  | Setting (name, e) ->
    put out (name.it ^ ": ");
    expression out whole e

and conditional_statement out condition yes no =
  put out "if (";
  expression out whole condition;
  put out ") ";
  body out yes;
  match no with
  | [] -> ()
  | [ { it = If (condition, yes, no); _ } ] ->
    put out " else ";
    conditional_statement out condition yes no
  | no ->
    put out " else ";
    body out no

(* [execute(t) during d | u] as a statement is read as [execute(t during d | u)]; [(during d run execute(t)) | u] is
   not. *)
and limited ?(inside = false) out e =
  match e.it with
  | During (on_cut, d, t) when is_limited_call e ->
    limited ~inside:true out t;
    put out (" " ^ during on_cut ^ " ");
    expression out postfix d
  | Until (on_cut, c, t) when is_limited_call e ->
    limited ~inside:true out t;
    put out (" " ^ until on_cut ^ " ");
    closure out c
  | Ensure (t, c) when is_limited_call e ->
    limited ~inside:true out t;
    put out " ensure ";
    closure out c
  | Binary _ when inside -> expression out postfix e
  | Binary (o, a, b) when begins_with_limit whole e ->
    limited out a;
    put out (" " ^ operator o ^ " ");
    expression out (level_of_operator o + 1) b
  | _ -> opening out e

(* An expression at the start of a statement, where a brace opens a block. *)
and opening out e = expression out (if starts_with_brace e then postfix + 1 else whole) e

(* A call at the start of a statement: without parentheses if its first argument can begin nothing else. *)
and command out name arguments =
  let rendered out =
    let render a =
      let buffer = Buffer.create 64 in
      argument { out with buffer } a;
      Buffer.contents buffer in
    List.map render arguments
  in
  let texts = rendered out in
  let begins_argument text =
    let begins word = String.length text > String.length word && String.sub text 0 (String.length word) = word in
    match text.[0] with
    | 'a' .. 'z' | 'A' .. 'Z' | '_' | '0' .. '9' | '\'' | '"' | '!' | '\xC0' .. '\xFF' ->
      not (List.exists begins [ "until "; "assure "; "during "; "within " ])
    | _ -> false
  in
  (* A closure first, and more behind it: [assert { C }, 'text']. *)
  let begins_with_closure = is_closure (List.hd arguments) && List.compare_length_with arguments 1 > 0 in
  put out name;
  if (begins_argument (List.hd texts) || begins_with_closure) && not (takes_ensure name arguments) then begin
    let long =
      List.fold_left (fun n text -> n + 2 + String.length text) (out.indent + String.length name) texts > width in
    if long && List.compare_length_with texts 1 > 0 && not (List.exists (fun text -> String.contains text '\n') texts)
    then begin
      put out " ";
      let within = inner out in
      List.iteri (fun i text -> if i > 0 then begin put out ","; line within end; put out text) (rendered within)
    end
    else begin
      put out " ";
      separated out ", " (put out) texts
    end
  end
  else begin
    put out "(";
    separated out ", " (put out) texts;
    put out ")"
  end

let until = Spelling.until
let during = Spelling.during
let give_back = Node.give_back
let operator = Spelling.operator

(* {1 Programs} *)

let is_function s =
  match s.it with
  | Function _ -> true
  | Expression _ | Assign _ | Define _ | Parameter _ | If _ | While _ | For _ | Return _ | Break | Continue | Block _
  | Setting _ -> false

let program ppf statements =
  let buffer = Buffer.create 4096 in
  let out = { buffer; indent = 0 } in
  let rec go = function
    | [] -> ()
    | [ s ] -> statement out s; put out "\n"
    | s :: (next :: _ as rest) ->
      statement out s;
      finish_before out next;
      put out (if is_function s || is_function next then "\n\n" else "\n");
      go rest
  in
  go statements;
  Format.pp_print_string ppf (Buffer.contents buffer)

let expression ppf e =
  let buffer = Buffer.create 256 in
  expression { buffer; indent = 0 } whole e;
  Format.pp_print_string ppf (Buffer.contents buffer)
