open Grammar

type owner = Nothing | Number | Named of string | Value

type t = {
  prefix : string;
  owner : owner;
  builder : Ast.builder option;
  block : string option;
  call : string option;
  text : bool;
  comment : bool;
}

let tokens source =
  List.filter (fun (t : Token.t) -> t.token <> EOF) (Scanner.scan ~file:"" source).tokens

let words = Scanner.words

let is_name x =
  match (Scanner.scan ~file:"" x).tokens with
  | [ { token = NAME y; _ }; { token = EOF; _ } ] -> x = y
  | _ -> false

let is_word text = is_name text || List.mem text words

(* An open bracket: its opener, and the command of the statement that is under way in it. *)
type frame = { opens : string option; braces : bool; command : string option }

let top = { opens = None; braces = true; command = None }

let text_of ~source (t : Token.t) = Token.text ~source t

(* The brackets that are open at the end of [tokens], the innermost first. *)
let frames tokens =
  let step (frames, (before : Token.t option)) (t : Token.t) =
    let frame, rest = match frames with [] -> top, [] | frame :: rest -> frame, rest in
    let name = match before with Some { token = NAME x; _ } -> Some x | Some _ | None -> None in
    let starts =
      match before with
      | None -> true
      | Some { token = SEPARATOR | LBRACE | ARROW; _ } -> true
      | Some _ -> t.newline && frame.braces in
    let frame =
      match t.token with
      | NAME x when starts -> { frame with command = Some x }
      | _ when starts -> { frame with command = None }
      | _ -> frame in
    let frames = frame :: rest in
    let frames =
      match t.token with
      | LBRACE -> { top with opens = (match name with Some _ -> name | None -> frame.command) } :: frames
      | LPAREN -> { opens = name; braces = false; command = name } :: frames
      | LBRACKET | HOLE_OPEN -> { opens = None; braces = false; command = None } :: frames
      | RPAREN | RBRACKET | HOLE_CLOSE | RBRACE -> rest
      | _ -> frames in
    frames, Some t
  in
  fst (List.fold_left step ([ top ], None) tokens)

(* Whether the last token is a string that is still open. *)
let is_open_text ~source (t : Token.t) =
  let text = text_of ~source t in
  match t.token with
  | STRING _ -> String.length text < 2 || text.[String.length text - 1] <> text.[0]
  | TEMPLATE_CLOSE -> text = ""
  | _ -> false

let in_comment source stop =
  let rest = String.sub source stop (String.length source - stop) in
  let line = match String.rindex_opt rest '\n' with
    | Some n -> String.sub rest (n + 1) (String.length rest - n - 1)
    | None -> rest in
  String.length (String.trim line) >= 2 && String.sub (String.trim line) 0 2 = "//"

let rec owner (reversed : Token.t list) path =
  match reversed with
  | { token = DOT | SAFE_DOT; _ } :: { token = INTEGER _ | NUMBER _; _ } :: _ when path = [] -> Number
  | { token = DOT | SAFE_DOT; _ } :: { token = NAME x; _ } :: rest ->
    (match rest with
     | { token = DOT | SAFE_DOT; _ } :: _ -> owner rest (x :: path)
     | _ -> Named (String.concat "." (x :: path)))
  | { token = DOT | SAFE_DOT; _ } :: _ -> Value
  | _ -> Nothing

(* Whether what follows [reversed], the last token first, is a statement of its own. *)
let begins_statement source prefix (reversed : Token.t list) =
  match reversed with
  | [] -> true
  | { token = SEPARATOR | LBRACE | ARROW | RBRACE; _ } :: _ -> true
  | { token; stop; _ } :: _ ->
    let between = String.sub source stop.pos_cnum (String.length source - String.length prefix - stop.pos_cnum) in
    String.contains between '\n' && not (Layout.is_incomplete token)

let at source offset =
  let source = String.sub source 0 (max 0 (min offset (String.length source))) in
  let reversed = List.rev (tokens source) in
  let prefix, before =
    match reversed with
    | t :: rest when t.stop.pos_cnum = String.length source && is_word (text_of ~source t) -> text_of ~source t, rest
    | _ -> "", reversed in
  let text = match reversed with t :: _ -> is_open_text ~source t | [] -> false in
  let stop = match reversed with t :: _ -> t.stop.pos_cnum | [] -> 0 in
  let open_frames = frames (List.rev reversed) in
  let frame = match open_frames with [] -> top | frame :: _ -> frame in
  let call =
    let is_command = prefix <> "" && frame.command = Some prefix in
    if is_command || (frame.braces && begins_statement source prefix before) then None else frame.command in
  { prefix; owner = owner before []; text; comment = (not text) && prefix = "" && in_comment source stop; call;
    builder = if frame.braces then Option.bind frame.opens Layout.builder else None;
    block = if frame.braces then frame.opens else None }

let header source x =
  let rec closed depth (tokens : Token.t list) =
    match tokens with
    | { token = LPAREN; _ } :: rest -> closed (depth + 1) rest
    | { token = RPAREN; stop; _ } :: _ when depth = 1 -> Some stop.pos_cnum
    | { token = RPAREN; _ } :: rest -> closed (depth - 1) rest
    | _ :: rest -> closed depth rest
    | [] -> None
  in
  let rec go (tokens : Token.t list) =
    match tokens with
    | { token = DEF; _ } :: ({ token = NAME y; start; _ } :: rest) when x = y ->
      Option.map (fun stop -> String.sub source start.pos_cnum (stop - start.pos_cnum)) (closed 0 rest)
    | _ :: rest -> go rest
    | [] -> None
  in
  go (tokens source)

let assigned source =
  let rec go names (tokens : Token.t list) =
    match tokens with
    | { token = NAME x; _ } :: ({ token = ASSIGN; _ } :: _ as rest) -> go (x :: names) rest
    | { token = DEF; _ } :: { token = NAME x; _ } :: rest -> go (x :: names) rest
    | { token = NAME x; _ } :: ({ token = IN | ARROW; _ } :: _ as rest) -> go (x :: names) rest
    | _ :: rest -> go names rest
    | [] -> List.rev names
  in
  let once names x = if List.mem x names then names else x :: names in
  List.rev (List.fold_left once [] (go [] (tokens source)))
