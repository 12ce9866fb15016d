open Grammar

(* How a token stands beside others. *)
type manner =
  | Operand             (* a name, a number, a string: a bracket after it belongs to it *)
  | Word                (* of a construct: blanks around it *)
  | Infix               (* an operator between two operands: blanks around it *)
  | Sign                (* [-], [+]: before an operand or between two *)
  | Prefix              (* [!] *)
  | Step                (* [++]: before or after an operand *)
  | Joint               (* [.], [..]: no blanks around it *)
  | Comma
  | Colon
  | Opening             (* [(], [[] *)
  | Closing             (* [)], []] *)
  | Brace               (* blanks around it *)
  | Closing_brace

let manner = function
  | NAME _ | INTEGER _ | NUMBER _ | STRING _ | TEMPLATE_OPEN | TEMPLATE_CLOSE | TEXT _ | WILDCARD | TRUE | FALSE
  | NULL -> Operand
  | IN | ARROW | QUESTION | ELVIS | ASSIGN | ASSIGN_OPERATOR _ | POWER | STAR | SLASH | PERCENT | SHIFT_LEFT
  | SHIFT_RIGHT | LESS | LESS_EQUAL | GREATER | GREATER_EQUAL | EQUAL | NOT_EQUAL | AMPERSAND | CARET | BAR | AND
  | OR -> Infix
  | PLUS | MINUS -> Sign
  | NOT -> Prefix
  | STEP _ -> Step
  | DOT | SAFE_DOT | RANGE | RANGE_LESS -> Joint
  | COMMA | SEPARATOR | EOF -> Comma
  | COLON -> Colon
  | LPAREN | LBRACKET | HOLE_OPEN -> Opening
  | RPAREN | RBRACKET | HOLE_CLOSE -> Closing
  | LBRACE | TRAILING | BLOCK -> Brace
  | RBRACE -> Closing_brace
  | _ -> Word

let token (pieces : Piece.t array) i = if i < 0 then SEPARATOR else pieces.(i).token

let ends_head (pieces : Piece.t array) i =
  token pieces i = RPAREN
  && (let opener = pieces.(i).partner in
      match token pieces (opener - 1) with
      | IF | WHILE | FOR -> true
      | NAME _ -> token pieces (opener - 2) = DEF
      | _ -> false)

(* Whether piece [i] is the end of an operand, to which what follows may belong. *)
let ends_operand (pieces : Piece.t array) i =
  i >= 0
  && match manner pieces.(i).token with
  | Operand | Closing_brace -> true
  | Closing -> not (ends_head pieces i)
  | Step -> true
  | Word | Infix | Sign | Prefix | Joint | Comma | Colon | Opening | Brace -> false

(* Whether piece [i] stands before its one operand. *)
let is_prefix (pieces : Piece.t array) i =
  match manner pieces.(i).token with
  | Prefix -> true
  | Sign | Step -> pieces.(i).starts || not (ends_operand pieces (i - 1))
  | Operand | Word | Infix | Joint | Comma | Colon | Opening | Closing | Brace | Closing_brace -> false

(* [execute (a | b) >> c], [execute (a | b) until { c }], [region (a + b).hull()]: parentheses at the start of a
   command's argument that goes on, if they were set apart. *)
let is_set_apart (pieces : Piece.t array) i =
  let next = pieces.(i).partner + 1 in
  pieces.(i - 1).starts && pieces.(i).set_apart
  && match manner (token pieces next) with
  | Infix | Sign | Joint -> true
  | Word -> not pieces.(next).starts
  | Operand | Prefix | Step | Comma | Colon | Opening | Closing | Brace | Closing_brace -> false

let before (pieces : Piece.t array) i =
  i > 0
  && match manner pieces.(i - 1).token, manner pieces.(i).token with
  | _, (Comma | Closing) | (Opening | Joint), _ | _, Joint -> false
  | _, Colon -> pieces.(i).ternary
  | Sign, (Sign | Step) -> true
  | (Prefix | Sign | Step), _ when is_prefix pieces (i - 1) -> false
  | _, Step -> is_prefix pieces i
  | _, Opening ->
    (match pieces.(i).token with
     | LPAREN -> not (ends_operand pieces (i - 1)) || is_set_apart pieces i
     | _ -> not (ends_operand pieces (i - 1)))
  | (Operand | Word | Infix | Sign | Prefix | Step | Comma | Colon | Closing | Brace | Closing_brace),
    (Operand | Word | Infix | Sign | Prefix | Brace | Closing_brace) -> true
