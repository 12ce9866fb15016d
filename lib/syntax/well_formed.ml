open Ast

let limit = 10_000

(* A node still to be checked. *)
type node = Expression_node of expression | Statement_node of statement

let expressions es = List.rev_map (fun e -> Expression_node e) es
let statements ss = List.rev_map (fun s -> Statement_node s) ss

let argument = function
  | Positional e | Named (_, e) -> [ Expression_node e ]
  | Keyed (k, e) -> [ Expression_node k; Expression_node e ]

let part = function Literal _ -> None | Hole e -> Some (Expression_node e)

let entry (key, e) =
  match key.it with
  | Name _ -> [ Expression_node e ]
  | Computed k -> [ Expression_node k; Expression_node e ]

let children_of_expression e =
  match e.it with
  | Null | Boolean _ | Integer _ | Number _ | String _ | Variable _ | Wildcard -> []
  | Template parts -> List.filter_map part parts
  | List es -> expressions es
  | Map entries -> List.concat_map entry entries
  | Range { first; last; inclusive = _ } -> expressions [ first; last ]
  | Closure { parameters = _; body } | Builder (_, body) -> statements body
  | Pick_else (settings, otherwise) -> statements settings @ statements otherwise
  | Unary (_, e) | Increment { target = e; _ } | Member { subject = e; _ } -> expressions [ e ]
  | Binary (_, a, b) | Elvis (a, b) | Index (a, b) | During (_, a, b) -> expressions [ a; b ]
  | Conditional (a, b, c) -> expressions [ a; b; c ]
  | Call { callee; arguments } -> Expression_node callee :: List.concat_map argument arguments
  | Repeat { rounds; body; until } ->
    let code = Option.fold until ~none:[] ~some:(fun (c : closure) -> statements c.body) in
    expressions (body :: Option.to_list rounds) @ code
  | Recruit (settings, c) -> statements settings @ statements c.body
  | When (c, t) | Wait_for (c, t) | Until (_, c, t) | Watch (t, c) | Ensure (t, c) ->
    Expression_node t :: statements c.body

let children_of_statement s =
  match s.it with
  | Expression e | Define (_, Some e) | Return (Some e) | Setting (_, e) -> expressions [ e ]
  | Parameter { value; _ } -> expressions [ value ]
  | Assign { target; operator = _; value } -> expressions [ target; value ]
  | Define (_, None) | Return None | Break | Continue -> []
  | Function { body; _ } | Block body -> statements body
  | If (c, yes, no) -> Expression_node c :: List.rev_append (statements yes) (statements no)
  | While (e, body) | For (_, e, body) -> Expression_node e :: statements body

let is_target e =
  match e.it with
  | Variable _ | Member _ | Index _ -> true
  | _ -> false

let target_fault what e =
  Diagnostic.error e.at (Printf.sprintf "this cannot be %s" what)
    ~hint:"only a variable, an element xs[i] or a member m.k can"

let own_fault = function
  | Statement_node { it = Assign { target; _ }; _ } when not (is_target target) ->
    Some (target_fault "assigned to" target)
  | Expression_node { it = Increment { target; by; _ }; _ } when not (is_target target) ->
    Some (target_fault (if by > 0 then "incremented" else "decremented") target)
  | Statement_node _ | Expression_node _ -> None

let children = function
  | Expression_node e -> children_of_expression e
  | Statement_node s -> children_of_statement s

let place = function Expression_node e -> e.at | Statement_node s -> s.at

let check nodes =
  let rec go faults deep = function
    | [] -> List.sort Diagnostic.compare faults
    | (depth, node) :: rest ->
      if depth > limit then
        let faults =
          if deep then faults
          else
            Diagnostic.error (place node) (Printf.sprintf "the program nests deeper than %d here" limit)
              ~hint:"give parts of it names"
            :: faults
        in
        go faults true rest
      else
        let faults = Option.fold (own_fault node) ~none:faults ~some:(fun fault -> fault :: faults) in
        go faults deep (List.rev_append (List.rev_map (fun child -> depth + 1, child) (children node)) rest)
  in
  go [] false (List.map (fun node -> 1, node) nodes)

let program p = check (statements p)
let expression e = check (expressions [ e ])
