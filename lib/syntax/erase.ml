open Ast

let bare it = { it; at = Location.none }
let name x = bare x.it

let rec expression e = bare (node e.it)

and node = function
  | (Null | Boolean _ | Integer _ | Number _ | String _ | Variable _ | Wildcard) as atom -> atom
  | Template parts -> Template (List.map part parts)
  | List es -> List (List.map expression es)
  | Map entries -> Map (List.map entry entries)
  | Range { first; last; inclusive } -> Range { first = expression first; last = expression last; inclusive }
  | Closure c -> Closure (closure c)
  | Unary (o, e) -> Unary (o, expression e)
  | Binary (o, a, b) -> Binary (o, expression a, expression b)
  | Conditional (c, a, b) -> Conditional (expression c, expression a, expression b)
  | Elvis (a, b) -> Elvis (expression a, expression b)
  | Increment { target; by; prefix } -> Increment { target = expression target; by; prefix }
  | Call { callee; arguments } -> Call { callee = expression callee; arguments = List.map argument arguments }
  | Member { subject; name = x; safe } -> Member { subject = expression subject; name = name x; safe }
  | Index (e, i) -> Index (expression e, expression i)
  | Builder (b, body) -> Builder (b, program body)
  | When (c, t) -> When (closure c, expression t)
  | Wait_for (c, t) -> Wait_for (closure c, expression t)
  | Until (on_cut, c, t) -> Until (on_cut, closure c, expression t)
  | During (on_cut, d, t) -> During (on_cut, expression d, expression t)
  | Watch (t, c) -> Watch (expression t, closure c)

and part = function
  | Literal _ as literal -> literal
  | Hole e -> Hole (expression e)

and entry (k, e) = bare (key k.it), expression e

and key = function
  | Name _ as name -> name
  | Computed e -> Computed (expression e)

and argument = function
  | Positional e -> Positional (expression e)
  | Named (x, e) -> Named (name x, expression e)
  | Keyed (k, e) -> Keyed (expression k, expression e)

and closure { parameters; body } = { parameters = Option.map (List.map name) parameters; body = program body }

and statement s = bare (statement_node s.it)

and statement_node = function
  | Expression e -> Expression (expression e)
  | Assign { target; operator; value } ->
    Assign { target = expression target; operator; value = expression value }
  | Define (x, e) -> Define (name x, Option.map expression e)
  | Function { name = x; parameters; body } ->
    Function { name = name x; parameters = List.map name parameters; body = program body }
  | If (c, yes, no) -> If (expression c, program yes, program no)
  | While (c, body) -> While (expression c, program body)
  | For (x, e, body) -> For (name x, expression e, program body)
  | Return e -> Return (Option.map expression e)
  | (Break | Continue) as jump -> jump
  | Block body -> Block (program body)
  | Setting (x, e) -> Setting (name x, expression e)

and program p = List.map statement p
