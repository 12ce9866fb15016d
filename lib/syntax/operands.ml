open Ast

let map_argument f = function
  | Positional e -> Positional (f e)
  | Named (k, e) -> Named (k, f e)
  | Keyed (k, e) -> Keyed (f k, f e)

let map f (e : expression) : expression =
  let it =
    match e.it with
    | Call { callee; arguments } -> Call { callee = f callee; arguments = List.map (map_argument f) arguments }
    | List es -> List (List.map f es)
    | Unary (o, e) -> Unary (o, f e)
    | Binary (o, a, b) -> Binary (o, f a, f b)
    | Conditional (a, b, c) -> Conditional (f a, f b, f c)
    | Elvis (a, b) -> Elvis (f a, f b)
    | Index (a, b) -> Index (f a, f b)
    | Member m -> Member { m with subject = f m.subject }
    | Range r -> Range { r with first = f r.first; last = f r.last }
    | it -> it
  in
  { e with it }
