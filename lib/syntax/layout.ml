open Grammar

(* {1 Kinds of tokens} *)

(* Whether a statement cannot end after [token], so that the next line belongs to it. *)
let is_incomplete = function
  | RANGE | RANGE_LESS | POWER | STAR | SLASH | PERCENT | PLUS | MINUS | SHIFT_LEFT | SHIFT_RIGHT | LESS
  | LESS_EQUAL | GREATER | GREATER_EQUAL | EQUAL | NOT_EQUAL | AMPERSAND | CARET | BAR | AND | OR | IN | NOT
  | COMMA | COLON | ARROW | DOT | SAFE_DOT | QUESTION | ELVIS | ASSIGN | ASSIGN_OPERATOR _
  | LPAREN | LBRACKET | LBRACE | TRAILING | BLOCK | HOLE_OPEN | SEPARATOR | BUILDER _ | RECRUIT | COMMAND _
  | PARAMETER | OTHERWISE -> true
  | RETURN | BREAK | CONTINUE -> false
  | token -> Words.is_word token

(* Whether no statement can begin with [token], so that it belongs to the line before. *)
let continues = function
  | RANGE | RANGE_LESS | POWER | STAR | SLASH | PERCENT | SHIFT_LEFT | SHIFT_RIGHT | LESS | LESS_EQUAL
  | GREATER | GREATER_EQUAL | EQUAL | NOT_EQUAL | AMPERSAND | CARET | BAR | AND | OR | IN
  | COMMA | COLON | DOT | SAFE_DOT | QUESTION | ELVIS | ELSE | OTHERWISE | RPAREN | RBRACKET | RBRACE | HOLE_CLOSE
  | SEPARATOR | EOF -> true
  | token -> Words.continues token

(* Whether an operand can end with [token]. *)
let ends_operand = function
  | NAME _ | INTEGER _ | NUMBER _ | STRING _ | TEMPLATE_CLOSE | WILDCARD | TRUE | FALSE | NULL | RPAREN
  | RBRACKET | RBRACE | STEP _ -> true
  | _ -> false

(* Whether a brace after [token] on the same line opens a closure that is one more argument. *)
let takes_closure = function
  | NAME _ | RPAREN | RBRACKET | RBRACE -> true
  | _ -> false

let builder = function
  | "pick" -> Some Ast.Pick
  | "imcPlan" -> Some Ast.Imc_plan
  | "mission" -> Some Ast.Mission
  | "pos" -> Some Ast.Pos
  | "allOf" -> Some Ast.All_of
  | "oneOf" | "choose" -> Some Ast.One_of
  | _ -> None

(* {1 Reading} *)

(* The contents of an open bracket. *)
type frame =
  | Enclosed                   (* [( )], [[ ]], a hole: lines do not matter *)
  | Body                       (* statements that are a statement, or the body of one *)
  | Value                      (* statements that are part of an expression *)
  | Picking                    (* the same for the settings of a [pick] *)

type state = {
  source : string;
  raw : Token.t array;
  partner : int array;
  header : bool array;                 (* which closing parentheses end the head of an [if], [def] ... *)
  mutable arranged : Token.t list;     (* in reverse *)
  mutable last : Grammar.token;        (* the one handed on last; SEPARATOR at the start *)
  mutable last_is_header : bool;
  mutable last_is_pick : bool;         (* whether it closes the settings of a [pick] *)
  mutable frames : frame list;
  mutable separate : bool;             (* whether a [;] or the end of a body calls for a separator *)
}

let raw_token state i = if i < Array.length state.raw then state.raw.(i).token else EOF
let same_line state i = i < Array.length state.raw && not state.raw.(i).newline

let is_key state i = raw_token state (i + 1) = COLON

(* Whether the word at [i] is a name there: of a member, [x.until], or of an argument, [until: x]. *)
let is_named state i =
  let is_member = i > 0 && match raw_token state (i - 1) with DOT | SAFE_DOT -> true | _ -> false in
  is_member || is_key state i

(* How far ahead the [run] of a [during] is looked for. *)
let horizon = 100

(* Whether the [until] or [during] at [i] begins an expression, [until { C } run T]: whether its own [run] follows. *)
let begins_expression state i =
  let rec run_follows i fuel =
    fuel > 0
    && match raw_token state i with
    | word when Words.is_word word && is_named state i -> run_follows (i + 1) (fuel - 1)
    | RUN -> true
    | SEPARATOR | COMMA | RPAREN | RBRACKET | RBRACE | HOLE_CLOSE | EOF -> false
    | token when Words.begins_task token -> false
    | LPAREN | LBRACKET | LBRACE | HOLE_OPEN -> run_follows (state.partner.(i) + 1) (fuel - 1)
    | token when state.raw.(i).newline && not (continues token) -> false
    | _ -> run_follows (i + 1) (fuel - 1)
  in
  match raw_token state i, raw_token state (i + 1) with
  | UNTIL _, LBRACE -> raw_token state (state.partner.(i + 1) + 1) = RUN
  | _, _ -> run_follows (i + 1) horizon

(* Whether the token at [i] can only begin an argument, when it follows a name. *)
let begins_argument state i =
  match raw_token state i with
  | NAME _ | INTEGER _ | NUMBER _ | STRING _ | TEMPLATE_OPEN | WILDCARD | TRUE | FALSE | NULL | NOT -> true
  | UNTIL _ | DURING _ -> is_key state i || begins_expression state i
  | token -> Words.begins_task token || (Words.is_word token && is_key state i)

let push state (token : Token.t) kind =
  state.arranged <- { token with token = kind } :: state.arranged;
  state.last <- kind;
  state.last_is_header <- false;
  state.last_is_pick <- false

let after_point state = match state.last with DOT | SAFE_DOT -> true | _ -> false

(* Marks the parenthesis that closes the head which the word at [i] begins. *)
let mark_header state i kind =
  let mark i = if raw_token state i = LPAREN then state.header.(state.partner.(i)) <- true in
  match kind with
  | IF | WHILE | FOR -> mark (i + 1)
  | DEF -> if same_line state (i + 2) then mark (i + 2)
  | _ -> ()

(* Whether parameters and an arrow follow the brace at [i]. *)
let begins_parameters state i =
  let rec from i =
    match raw_token state i, raw_token state (i + 1) with
    | NAME _, COMMA -> from (i + 2)
    | NAME _, ARROW -> true
    | _, _ -> false
  in
  raw_token state (i + 1) = ARROW || from (i + 1)

let brace state i =
  let same_line = same_line state i in
  match state.last with
  | SEPARATOR | LBRACE | TRAILING | BLOCK | ARROW when begins_parameters state i -> LBRACE, Value
  | SEPARATOR | LBRACE | TRAILING | BLOCK | ARROW | ELSE -> BLOCK, Body
  | BUILDER Pick -> BLOCK, Picking
  | BUILDER _ | RECRUIT | OTHERWISE -> BLOCK, Value
  | RPAREN when state.last_is_header -> BLOCK, Body
  | last when takes_closure last && same_line -> TRAILING, Value
  | _ -> LBRACE, Value

(* Whether an [if] that stands without braces in the statement so far, and has no [else] yet, may have one here. *)
let if_lacks_else state =
  let rec back (tokens : Token.t list) depth elses =
    match tokens with
    | [] -> false
    | { token; _ } :: tokens -> (
        match token with
        | RPAREN | RBRACKET | RBRACE | HOLE_CLOSE -> back tokens (depth + 1) elses
        | LPAREN | LBRACKET | LBRACE | TRAILING | BLOCK | HOLE_OPEN -> depth > 0 && back tokens (depth - 1) elses
        | SEPARATOR when depth = 0 -> false
        | ELSE when depth = 0 -> back tokens depth (elses + 1)
        | IF when depth = 0 -> elses = 0 || back tokens depth (elses - 1)
        | _ -> back tokens depth elses)
  in
  back state.arranged 0 0

(* Whether [parameter] at [i] declares one: [parameter n = 3], at the start of a statement. *)
let declares_parameter state i =
  (match state.last with SEPARATOR | BLOCK | LBRACE | TRAILING | ARROW -> true | _ -> false)
  && same_line state (i + 1)
  && match raw_token state (i + 1), raw_token state (i + 2) with NAME _, ASSIGN -> true | _, _ -> false

let in_statements state =
  match state.frames with
  | [] | (Body | Value | Picking) :: _ -> true
  | Enclosed :: _ -> false

(* Whether the [until] or [during] at [i] limits the task before it, which may be on the line before. *)
let stands_behind state i (token : Token.t) =
  ends_operand state.last && not state.last_is_header
  && not (token.newline && in_statements state && begins_expression state i)

(* The meaning of the token at [i], given those before and after it. *)
let classify state i (token : Token.t) =
  match token.token with
  | TRUE | FALSE | NULL when after_point state -> NAME (Token.text ~source:state.source token)
  | word when Words.is_word word && is_named state i -> NAME (Token.text ~source:state.source token)
  | UNTIL Completes when stands_behind state i token -> AFTER_UNTIL
  | UNTIL Fails when stands_behind state i token -> AFTER_ASSURE
  | DURING on_cut when stands_behind state i token -> AFTER_DURING on_cut
  | ELSE when state.last_is_pick && not (if_lacks_else state) -> OTHERWISE
  | NAME "parameter" when declares_parameter state i -> PARAMETER
  | NAME x as name ->
    if after_point state || raw_token state (i + 1) <> LBRACE then
      if same_line state (i + 1) && begins_argument state (i + 1) && state.last <> DEF then COMMAND x else name
    else if x = "recruit" then RECRUIT
    else Option.fold (builder x) ~none:name ~some:(fun builder -> BUILDER builder)
  | kind -> kind

(* Whether a separator belongs between the last token and one of this [kind]. *)
let separates state (token : Token.t) kind =
  in_statements state
  && state.last <> SEPARATOR
  && (match state.last with LBRACE | TRAILING | BLOCK | ARROW -> false | _ -> true)
  && (match kind with RBRACE | EOF | ELSE | OTHERWISE -> false | _ -> true)
  && (state.separate
      || token.newline
         && not (is_incomplete state.last)
         && not state.last_is_header
         && not (continues kind))

(* A separator stands right after the last token. *)
let push_separator state =
  match state.arranged with
  | [] -> ()
  | last :: _ -> push state { last with start = last.stop; newline = false } SEPARATOR

let open_frame state i kind frame token =
  mark_header state i kind;
  push state token kind;
  state.frames <- frame :: state.frames

let step state i (token : Token.t) =
  let kind = classify state i token in
  match kind with
  | SEPARATOR when in_statements state -> state.separate <- true
  | _ ->
    if separates state token kind then push_separator state;
    state.separate <- false;
    (* A separator before it determines the meaning of an [until] or a [during]. *)
    let kind = if state.last = SEPARATOR then classify state i token else kind in
    match kind with
    | LPAREN | LBRACKET | HOLE_OPEN -> open_frame state i kind Enclosed token
    | LBRACE ->
      let kind, frame = brace state i in
      open_frame state i kind frame token
    | RPAREN | RBRACKET | HOLE_CLOSE | RBRACE ->
      push state token kind;
      if kind = RPAREN then state.last_is_header <- state.header.(i);
      let closed, frames =
        match state.frames with
        | [] -> Enclosed, []
        | frame :: frames -> frame, frames in
      state.frames <- frames;
      state.last_is_pick <- (closed = Picking);
      state.separate <- (closed = Body)
    | _ ->
      mark_header state i kind;
      push state token kind

let arrange ~source { Brackets.tokens; partner; faults = _ } =
  let state =
    { source; raw = tokens; partner; header = Array.make (Array.length tokens) false; arranged = [];
      last = SEPARATOR; last_is_header = false; last_is_pick = false; frames = []; separate = false } in
  Array.iteri (step state) tokens;
  Array.of_list (List.rev state.arranged)
