open Dolphin_syntax.Ast

let rec statement f acc (s : statement) =
  match s.it with
  | Expression e | Setting (_, e) | Return (Some e) | Define (_, Some e) -> expression f acc e
  | Parameter { value; _ } -> expression f acc value
  | Assign { target; value; _ } -> expression f (expression f acc target) value
  | Function { body; _ } | Block body -> List.fold_left (statement f) acc body
  | If (e, yes, no) -> List.fold_left (statement f) (expression f acc e) (yes @ no)
  | While (e, body) | For (_, e, body) -> List.fold_left (statement f) (expression f acc e) body
  | Return None | Define (_, None) | Break | Continue -> acc

and expression f acc (e : expression) =
  let acc = f acc e in
  let go = expression f and body = List.fold_left (statement f) in
  match e.it with
  | Null | Boolean _ | Integer _ | Number _ | String _ | Variable _ | Wildcard -> acc
  | Template parts -> List.fold_left (fun acc -> function Literal _ -> acc | Hole e -> go acc e) acc parts
  | List es -> List.fold_left go acc es
  | Map entries -> List.fold_left (fun acc (_, e) -> go acc e) acc entries
  | Range { first = a; last = b; _ } | Binary (_, a, b) | Elvis (a, b) | Index (a, b) | During (_, a, b) ->
    go (go acc a) b
  | Closure c -> body acc c.body
  | Unary (_, e) | Increment { target = e; _ } | Member { subject = e; _ } -> go acc e
  | Conditional (a, b, c) -> go (go (go acc a) b) c
  | Call { callee; arguments } ->
    let argument acc = function
      | Positional e | Named (_, e) -> go acc e
      | Keyed (k, e) -> go (go acc k) e
    in
    List.fold_left argument (go acc callee) arguments
  | Builder (_, statements) -> body acc statements
  | Pick_else (settings, otherwise) -> body (body acc settings) otherwise
  | Recruit (settings, c) -> body (body acc settings) c.body
  | When (c, e) | Wait_for (c, e) | Until (_, c, e) -> go (body acc c.body) e
  | Watch (e, c) | Ensure (e, c) -> body (go acc e) c.body
  | Repeat { rounds; body = e; until } ->
    let acc = go (Option.fold rounds ~none:acc ~some:(go acc)) e in
    Option.fold until ~none:acc ~some:(fun c -> body acc c.body)
