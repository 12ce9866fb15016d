open Ast

let name f x = { x with at = f x.at }

let rec expression f e = { it = node f e.it; at = f e.at }

and node f = function
  | (Null | Boolean _ | Integer _ | Number _ | String _ | Variable _ | Wildcard) as atom -> atom
  | Template parts -> Template (List.map (part f) parts)
  | List es -> List (List.map (expression f) es)
  | Map entries -> Map (List.map (entry f) entries)
  | Range { first; last; inclusive } -> Range { first = expression f first; last = expression f last; inclusive }
  | Closure c -> Closure (closure f c)
  | Unary (o, e) -> Unary (o, expression f e)
  | Binary (o, a, b) -> Binary (o, expression f a, expression f b)
  | Conditional (c, a, b) -> Conditional (expression f c, expression f a, expression f b)
  | Elvis (a, b) -> Elvis (expression f a, expression f b)
  | Increment { target; by; prefix } -> Increment { target = expression f target; by; prefix }
  | Call { callee; arguments } -> Call { callee = expression f callee; arguments = List.map (argument f) arguments }
  | Member { subject; name = x; safe } -> Member { subject = expression f subject; name = name f x; safe }
  | Index (e, i) -> Index (expression f e, expression f i)
  | Builder (b, body) -> Builder (b, program f body)
  | Pick_else (settings, otherwise) -> Pick_else (program f settings, program f otherwise)
  | Recruit (settings, c) -> Recruit (program f settings, closure f c)
  | When (c, t) -> When (closure f c, expression f t)
  | Wait_for (c, t) -> Wait_for (closure f c, expression f t)
  | Until (on_cut, c, t) -> Until (on_cut, closure f c, expression f t)
  | During (on_cut, d, t) -> During (on_cut, expression f d, expression f t)
  | Watch (t, c) -> Watch (expression f t, closure f c)
  | Ensure (t, c) -> Ensure (expression f t, closure f c)
  | Repeat { rounds; body; until } ->
    let rounds = Option.map (expression f) rounds in
    Repeat { rounds; body = expression f body; until = Option.map (closure f) until }

and part f = function
  | Literal _ as literal -> literal
  | Hole e -> Hole (expression f e)

and entry f (k, e) = { it = key f k.it; at = f k.at }, expression f e

and key f = function
  | Name _ as name -> name
  | Computed e -> Computed (expression f e)

and argument f = function
  | Positional e -> Positional (expression f e)
  | Named (x, e) -> Named (name f x, expression f e)
  | Keyed (k, e) -> Keyed (expression f k, expression f e)

and closure f { parameters; body } = { parameters = Option.map (List.map (name f)) parameters; body = program f body }

and statement f s = { it = statement_node f s.it; at = f s.at }

and statement_node f = function
  | Expression e -> Expression (expression f e)
  | Assign { target; operator; value } ->
    Assign { target = expression f target; operator; value = expression f value }
  | Define (x, e) -> Define (name f x, Option.map (expression f) e)
  | Function { name = x; parameters; body } ->
    Function { name = name f x; parameters = List.map (name f) parameters; body = program f body }
  | Parameter { name = x; value; description } ->
    Parameter { name = name f x; value = expression f value; description = Option.map (name f) description }
  | If (c, yes, no) -> If (expression f c, program f yes, program f no)
  | While (c, body) -> While (expression f c, program f body)
  | For (x, e, body) -> For (name f x, expression f e, program f body)
  | Return e -> Return (Option.map (expression f) e)
  | (Break | Continue) as jump -> jump
  | Block body -> Block (program f body)
  | Setting (x, e) -> Setting (name f x, expression f e)

and program f p = List.map (statement f) p
