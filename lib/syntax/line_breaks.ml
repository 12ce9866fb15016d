open Grammar
open Piece

let is_brace = function LBRACE | TRAILING | BLOCK -> true | _ -> false

(* The beginning of the body of the brace at [opener]: after its parameters. *)
let body_start pieces opener =
  let rec arrow i =
    match pieces.(i).token with
    | ARROW -> i + 1
    | NAME _ | COMMA -> arrow (i + 1)
    | _ -> opener + 1
  in
  if pieces.(opener + 1).starts then opener + 1 else arrow (opener + 1)

(* {1 One rule} *)

(* Whether piece [i] belongs on the line of the one before it. *)
let is_joined pieces i =
  pieces.(i).comments = []
  && match pieces.(i - 1).token, pieces.(i).token with
  | (BUILDER _ | ELSE), (LBRACE | BLOCK) -> true
  | word, (LBRACE | BLOCK) when Words.takes_code word -> true
  | RPAREN, BLOCK -> Spacing.ends_head pieces (i - 1)
  | RBRACE, ELSE | ELSE, IF -> true
  | _, COMMA -> true
  | _, _ -> false

let join pieces =
  for i = 1 to Array.length pieces - 1 do
    if pieces.(i).breaks && is_joined pieces i then begin
      pieces.(i).breaks <- false;
      if pieces.(i).token = COMMA then pieces.(i + 1).breaks <- true
    end
  done

(* Parentheses and square brackets close as they open. *)
let settle_brackets pieces =
  let settle opener piece =
    match piece.token with
    | LPAREN | LBRACKET ->
      let closer = pieces.(piece.partner) in
      let first = pieces.(opener + 1) in
      if opener + 1 = piece.partner then begin if closer.comments = [] then closer.breaks <- false end
      else if first.breaks then closer.breaks <- true
      else if closer.comments = [] then closer.breaks <- false
    | _ -> ()
  in
  Array.iteri settle pieces

(* [before.(i)] is how many pieces up to [i] begin a line. *)
let breaks_before pieces =
  let count = ref 0 in
  Array.map (fun piece -> if piece.breaks then incr count; !count) pieces

let settle_braces pieces =
  let before = breaks_before pieces in
  let is_broken opener = before.(pieces.(opener).partner) > before.(opener) in
  let settle i piece =
    if is_brace piece.token then begin
      let start = body_start pieces i in
      for parameter = i + 1 to start - 1 do
        if pieces.(parameter).comments = [] then pieces.(parameter).breaks <- false
      done;
      let closer = pieces.(piece.partner) in
      if start = piece.partner && closer.comments = [] then closer.breaks <- false
      else closer.breaks <- is_broken i
    end;
    if piece.starts && i > 0 && (piece.enclosing < 0 || is_broken piece.enclosing) then piece.breaks <- true
  in
  Array.iteri settle pieces

let settle pieces =
  join pieces;
  settle_brackets pieces;
  settle_braces pieces

(* {1 Long lines} *)

(* How loosely a line may end before piece [i]: the loosest first. *)
type looseness =
    Body | Element | Joint | Choice | Either | Both | Beside | Chain | Sum | Operator | Limit | Inside | Value

(* Whether piece [i] stands between a closure's brace and its arrow. *)
let is_in_parameters pieces i =
  let opener = pieces.(i).enclosing in
  opener >= 0 && is_brace pieces.(opener).token && i < body_start pieces opener

let looseness pieces i =
  match pieces.(i - 1).token, pieces.(i).token with
  | _, token when Words.place token = Some Joins -> Some Joint
  | _, (COMMA | RPAREN | RBRACKET | RBRACE | EOF | ARROW) -> None
  | _, (QUESTION | ELVIS) -> Some Choice
  | _, COLON when pieces.(i).ternary -> Some Choice
  | COMMA, _ when is_in_parameters pieces i -> None
  | COMMA, _ -> Some Element
  | OR, _ -> Some Either
  | AND, _ -> Some Both
  | BAR, _ -> Some Beside
  | (SHIFT_LEFT | SHIFT_RIGHT), _ -> Some Chain
  | (PLUS | MINUS), _ when not (Spacing.is_prefix pieces (i - 1)) -> Some Sum
  | (STAR | SLASH | PERCENT | POWER | AMPERSAND | CARET | EQUAL | NOT_EQUAL | LESS | LESS_EQUAL | GREATER
    | GREATER_EQUAL | IN), _ -> Some Operator
  | _, token when Words.place token = Some Limits -> Some Limit
  | (LPAREN | LBRACKET), _ -> Some Inside
  | (ASSIGN | ASSIGN_OPERATOR _), _ -> Some Value
  | _, _ when pieces.(i).starts -> Some Body
  | _, _ -> None

(* The body in braces at the end of the line up to [stop], if it has one: its beginning. *)
let last_body pieces ~first ~stop =
  let rec from i =
    if i <= first then None
    else
      match pieces.(i).token with
      | RPAREN | RBRACKET | COMMA | EOF -> from (i - 1)
      | RBRACE when pieces.(i).partner > first ->
        let start = body_start pieces pieces.(i).partner in
        if start < i && start > first then Some start else None
      | _ -> None
  in
  from (stop - 1)

let rank pieces (i, looseness) = (if looseness = Value then max_int else pieces.(i).depth), looseness

let shorten pieces ~columns ~width ~first ~stop =
  let all = List.init (stop - first - 1) (fun k -> first + 1 + k) in
  let candidates = List.filter_map (fun i -> Option.map (fun l -> i, l) (looseness pieces i)) all in
  let break i = pieces.(i).breaks <- true in
  match last_body pieces ~first ~stop, candidates with
  | Some start, _ -> break start; true
  | None, [] -> false
  | None, one :: others ->
    let best = List.fold_left (fun a b -> min a (rank pieces b)) (rank pieces one) others in
    let same = List.filter (fun candidate -> rank pieces candidate = best) candidates in
    let fitting = List.filter (fun (i, _) -> columns.(i - 1) <= width) same in
    (match snd best, List.rev fitting with
     | Element, (last, _) :: _ -> break last
     | Element, [] -> break (fst (List.hd same))
     | _, _ -> List.iter (fun (i, _) -> break i) same);
    true
