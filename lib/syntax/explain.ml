open Grammar

(* The token at which the grammar is stuck. *)
type place = {
  source : string;
  tokens : Token.t array;
  index : int;
  acceptable : Grammar.token -> bool;
}

let kind place i = if i >= 0 && i < Array.length place.tokens then place.tokens.(i).token else EOF
let this place = kind place place.index
let before place n = kind place (place.index - n)
let text_of place i = Token.text ~source:place.source place.tokens.(i)

(* {1 Names of tokens} *)

let quoted text =
  if String.length text <= 40 && not (String.contains text '\n') then Printf.sprintf "'%s'" text
  else "this text"

(* How the program spells token [i]. *)
let spelt place i =
  match kind place i with
  | EOF -> "end of the text"
  | SEPARATOR when text_of place i = ";" -> "';'"
  | SEPARATOR ->
    let stop = place.tokens.(i).stop.Lexing.pos_cnum in
    let rec next i =
      if i < String.length place.source && (place.source.[i] = ' ' || place.source.[i] = '\t') then next (i + 1)
      else i in
    let next = next stop in
    if next < String.length place.source && place.source.[next] = ';' then "';'"
    else if next < String.length place.source && place.source.[next] = '\n' then "end of the line"
    else "end of the statement"
  | STRING _ ->
    let text = text_of place i in
    if String.length text <= 40 && not (String.contains text '\n') then "text " ^ text else "text"
  | TEMPLATE_OPEN | TEXT _ -> "text"
  | TEMPLATE_CLOSE -> "end of the string"
  | _ -> quoted (text_of place i)

let listed names =
  match List.rev names with
  | [] -> None
  | [ one ] -> Some one
  | last :: others -> Some (String.concat ", " (List.rev others) ^ " or " ^ last)

(* The tokens that could stand here instead. *)
let expected place =
  let when_acceptable token name = if place.acceptable token then [ name ] else [] in
  let operand =
    if place.acceptable (INTEGER 0) then [ "an expression" ] else when_acceptable (NAME "x") "a name" in
  let rest =
    if place.acceptable (INTEGER 0) then
      when_acceptable RPAREN "')'" @ when_acceptable RBRACKET "']'"
    else
      List.concat
        [ when_acceptable LPAREN (if place.acceptable PLUS then "" else "'('");
          when_acceptable BLOCK "'{'"; when_acceptable LBRACE "'{'";
          when_acceptable IN (if place.acceptable PLUS then "" else "'in'");
          when_acceptable ASSIGN (if place.acceptable PLUS then "" else "'='");
          when_acceptable ARROW "'->'"; when_acceptable COLON "':'";
          when_acceptable PLUS "an operator"; when_acceptable COMMA "','";
          when_acceptable RPAREN "')'"; when_acceptable RBRACKET "']'"; when_acceptable HOLE_CLOSE "'}'";
          when_acceptable SEPARATOR "the end of the statement" ]
  in
  listed (List.filter (fun name -> name <> "") (operand @ rest))

(* {1 Surroundings} *)

(* How far back one looks. *)
let horizon = 2_000

let is_opener = function LPAREN | LBRACKET | LBRACE | TRAILING | BLOCK | HOLE_OPEN -> true | _ -> false
let is_closer = function RPAREN | RBRACKET | RBRACE | HOLE_CLOSE -> true | _ -> false

(* The nearest token before [i], brackets taken as wholes, at which [stops]; brackets that are still open
   always stop. *)
let back place i stops =
  let rec go i depth fuel =
    if i < 0 || fuel = 0 then -1
    else
      let token = kind place i in
      if is_closer token then go (i - 1) (depth + 1) (fuel - 1)
      else if is_opener token then if depth = 0 then i else go (i - 1) (depth - 1) (fuel - 1)
      else if depth = 0 && stops token then i
      else go (i - 1) depth (fuel - 1)
  in
  go (i - 1) 0 horizon

(* The bracket that is open around the place. *)
let opener place = back place place.index (fun _ -> false)

(* The beginning of the statement. *)
let statement place = back place place.index (function SEPARATOR | ARROW -> true | _ -> false) + 1

(* The word that heads the parenthesis around the place: [if], [while], [for] or another. *)
let head place =
  let opener = opener place in
  match kind place opener with
  | LPAREN when opener > 0 -> kind place (opener - 1)
  | _ -> EOF

(* The word before the closure that ends right before the place. *)
let word_before_closure place =
  match before place 1 with
  | RBRACE ->
    let opener = opener { place with index = place.index - 1 } in
    if opener > 0 then kind place (opener - 1) else EOF
  | _ -> EOF

(* The text from token [i] on, up to the end of the statement or a token that [ends] it, as written. *)
let rest ?(ends = fun _ -> false) place i =
  let rec last i depth =
    match kind place (i + 1) with
    | EOF -> i
    | token when depth = 0 && ends token -> i
    | SEPARATOR when depth = 0 -> i
    | token when is_opener token -> last (i + 1) (depth + 1)
    | token when is_closer token -> if depth = 0 then i else last (i + 1) (depth - 1)
    | _ -> last (i + 1) depth
  in
  let first = place.tokens.(i).start.Lexing.pos_cnum in
  let depth = if is_opener (kind place i) then 1 else 0 in
  let last = place.tokens.(last i depth).stop.Lexing.pos_cnum in
  let text = String.sub place.source first (last - first) in
  if String.length text <= 60 && not (String.contains text '\n') then text else "..."

let rest_of_statement place i = rest place i

(* The argument of a call without parentheses within a task: operators of tasks and their words go on after it. *)
let arguments place i =
  let ends = function
    | SHIFT_RIGHT | BAR -> true
    | token -> Words.continues token in
  rest ~ends place i

(* {1 Likely mistakes}

    Each rule gives a message and a hint, or leaves the place to the next rule. *)

let is_word token = token = OTHERWISE || (token <> WILDCARD && Words.place token <> None)

(* Whether the place is among the parameters of a function or of a closure. *)
let is_parameter place =
  let opener = opener place in
  let rec arrow i =
    match kind place i with
    | ARROW -> true
    | NAME _ | COMMA | INTEGER _ | NUMBER _ | STRING _ | ASSIGN -> arrow (i + 1)
    | _ -> false
  in
  match kind place opener with
  | LPAREN -> opener > 1 && kind place (opener - 2) = DEF
  | LBRACE | TRAILING | BLOCK -> arrow place.index
  | _ -> false

let assignment place =
  match this place, head place with
  | ASSIGN, (IF | WHILE) -> Some ("'=' does not compare", "write '==' to compare")
  | ASSIGN, _ when is_parameter place ->
    Some ("a parameter has no value of its own", "give the value in each call, or test the parameter for null")
  | COMMAND _, FOR -> None
  | _, FOR ->
    Some ("a 'for' runs over the elements of something", "write for (x in xs) { ... }, such as for (i in 1..3)")
  | ASSIGN, _ when not (place.acceptable (INTEGER 0)) ->
    begin match before place 2, before place 1, kind place (opener place) with
      | COMMAND ("post" | "consume" | "poll" as f), NAME x, _ ->
        let value = rest_of_statement place (place.index + 1) in
        Some ("'=' cannot stand within an expression", Printf.sprintf "a pair is written %s %s: %s" f x value)
      | ASSIGN, NAME x, _ ->
        Some ("an assignment has no value", Printf.sprintf "write %s = ... in a statement of its own" x)
      | COMMAND _, NAME x, _ when statement place < place.index - 2 && kind place (opener place) <> LPAREN ->
        Some ("unexpected '='", Printf.sprintf "a ';' or a new line is missing before '%s ='" x)
      | COMMAND _, NAME x, _ ->
        Some ("a variable has no type before its name", Printf.sprintf "write def %s = ..." x)
      | _, NAME x, LPAREN ->
        Some ("'=' cannot stand within an expression", Printf.sprintf "a named argument is written %s: value" x)
      | _, NAME x, LBRACKET ->
        Some ("'=' cannot stand within an expression", Printf.sprintf "an entry of a map is written %s: value" x)
      | _ -> Some ("this cannot be assigned to", "only a variable, an element xs[i] or a member m.k can")
    end
  | ASSIGN_OPERATOR _, _ -> Some ("this cannot be assigned to", "only a variable, an element xs[i] or a member m.k can")
  | _ -> None

(* The construct that a word begins, and how it is written, if a closure follows the word. *)
let construct = function
  | WHEN -> Some ("when", "when { condition } then task")
  | WAIT_FOR -> Some ("waitFor", "waitFor { condition } then task")
  | UNTIL on_cut ->
    let word = Spelling.until on_cut in
    Some (word, word ^ " { condition } run task")
  | AFTER_UNTIL -> Some ("until", "task until { condition }")
  | AFTER_ASSURE -> Some ("assure", "task assure { condition }")
  | ON_ERROR -> Some ("onError", "watch task onError { error -> ... }")
  | ENSURE -> Some ("ensure", "task ensure { post key: value }")
  | _ -> None

let timed on_cut =
  let word = Spelling.during on_cut in
  (word ^ " time run task", "task " ^ word ^ " time")

let recruit = "recruit { type 'UAV' } then { vehicle -> task }"

let missing_word place =
  let missing word form = Some (Printf.sprintf "'%s' is missing here" word, "write " ^ form) in
  let before_closure = word_before_closure place in
  match before_closure, construct before_closure with
  | (WHEN | WAIT_FOR), Some (_, form) -> missing "then" form
  | RECRUIT, _ -> missing "then" recruit
  | UNTIL _, Some (_, form) -> missing "run" form
  | (AFTER_UNTIL | AFTER_ASSURE), Some (word, form) when not (is_closer (this place) || this place = SEPARATOR) ->
    missing "run" (Printf.sprintf "%s { condition } run task, or %s" word form)
  | _ ->
    let is_during = function DURING _ | AFTER_DURING _ | SEPARATOR | COMMA -> true | _ -> false in
    let during = kind place (back place place.index is_during) in
    if place.acceptable ON_ERROR then missing "onError" "watch task onError { error -> ... }"
    else if place.acceptable RUN then
      missing "run" (fst (timed (match during with DURING on_cut -> on_cut | _ -> Ast.Completes)))
    else
      match this place, during with
      | (NAME _ | COMMAND _ | BUILDER _), AFTER_DURING on_cut ->
        let first, after = timed on_cut in
        missing "run" (Printf.sprintf "%s, or %s" first after)
      | _ -> None

(* [within = 4]: until and assure lack a brace. *)
let assigned_word place =
  match before place 1, this place with
  | (DURING on_cut | AFTER_DURING on_cut), (ASSIGN | ASSIGN_OPERATOR _) ->
    let word = Spelling.during on_cut in
    let message = Printf.sprintf "'%s' is a word of the language: no variable has this name" word in
    Some (message, "write " ^ fst (timed on_cut))
  | _ -> None

let missing_brace place =
  match before place 1, construct (before place 1) with
  | _, Some (word, form) -> Some (Printf.sprintf "a '{' is missing after '%s'" word, "write " ^ form)
  | RPAREN, None when place.acceptable BLOCK && not (place.acceptable (INTEGER 0)) ->
    Some ("a '{' is missing here", "the body of a function stands in braces")
  | _ -> None

let missing_block place =
  match before place 1 with
  | THEN when not (place.acceptable (INTEGER 0)) -> Some ("a '{' is missing after 'then'", "write " ^ recruit)
  | OTHERWISE -> Some ("a '{' is missing after 'else'", "write pick { ... } else { what to do without }")
  | _ -> None

let missing_parenthesis place =
  match before place 1 with
  | IF -> Some ("a '(' is missing after 'if'", "write if (condition) { ... }")
  | WHILE -> Some ("a '(' is missing after 'while'", "write while (condition) { ... }")
  | FOR -> Some ("a '(' is missing after 'for'", "write for (x in xs) { ... }")
  | _ -> None

let missing_parameters place =
  match before place 2, before place 1, this place with
  | DEF, NAME f, (LBRACE | TRAILING | BLOCK) ->
    Some (Printf.sprintf "the parameters of '%s' are missing" f, Printf.sprintf "write def %s() { ... }" f)
  | _ -> None

let misplaced_word place =
  match this place with
  | ELSE | OTHERWISE ->
    Some ("'else' without an 'if'",
          "an 'else' follows the body of an 'if', or the settings of a pick: pick { ... } else { ... }")
  | THEN -> Some ("'then' cannot stand here", "'then' follows when { ... }, waitFor { ... } and recruit { ... }")
  | RUN ->
    Some ("'run' cannot stand here",
          "'run' follows until { ... }, assure { ... }, waitFor { ... }, during time, within time and using key: value")
  | ON_ERROR -> Some ("'onError' cannot stand here", "write watch task onError { error -> ... }")
  | ARROW when (match before place 2, before place 1 with (NAME _ | COMMAND _), NAME _ -> true | _ -> false) ->
    Some ("a name has no type before it", Printf.sprintf "write only %s" (text_of place (place.index - 1)))
  | ARROW when kind place (opener place) = BLOCK ->
    Some ("'->' cannot stand here",
          "this '{' opens a block; put a closure in parentheses: ({ a -> ... })")
  | ARROW -> Some ("'->' cannot stand here", "'->' ends the parameters of a closure: { a, b -> ... }")
  | (IF | WHILE | FOR | RETURN | BREAK | CONTINUE | DEF) as word when place.acceptable (INTEGER 0) ->
    let spelling = text_of place place.index in
    Some (Printf.sprintf "'%s' begins a statement; it cannot stand within an expression" spelling,
          if word = IF then "write condition ? a : b" else "put it on a line of its own")
  | word when is_word word && place.acceptable (NAME "x") && not (place.acceptable (INTEGER 0)) ->
    Some (Printf.sprintf "'%s' is a word of the language" (text_of place place.index), "choose another name")
  | _ -> None

let command place =
  match this place, kind place (place.index + 1) with
  | COMMAND f, _ when place.acceptable (INTEGER 0) ->
    Some ("a call within an expression needs parentheses",
          Printf.sprintf "write %s(%s)" f (arguments place (place.index + 1)))
  | COMMAND _, NAME x when place.acceptable (NAME x) ->
    Some ("a name has no type before it", Printf.sprintf "write only %s" x)
  | _ -> None

(* [move -30, -50] reads as a subtraction, up to the comma. *)
let negative_argument place =
  let first = statement place in
  match this place, kind place first, kind place (first + 1) with
  | COMMA, NAME f, MINUS ->
    Some (Printf.sprintf "'%s -' is read as a subtraction" f,
          Printf.sprintf "write %s(%s)" f (rest_of_statement place (first + 1)))
  | _ -> None

(* [message (1), 2] and [message [1, 2]]: the bracket behind the name belongs to it alone. *)
let greedy_bracket place =
  let opener = opener place in
  let first = statement (if kind place opener = LBRACKET then { place with index = opener } else place) in
  let call f = Printf.sprintf "write %s(%s)" f (rest_of_statement place (first + 1)) in
  match this place, kind place first, kind place (first + 1) with
  | COMMA, NAME f, LPAREN when opener < first ->
    Some ("unexpected ','", Printf.sprintf "parentheses behind %s hold all its arguments: %s" f (call f))
  | COMMA, NAME f, LBRACKET when opener = first + 1 ->
    Some ("unexpected ','", Printf.sprintf "brackets behind %s are for one of its elements: %s" f (call f))
  | COLON, NAME (("post" | "consume" | "poll" | "count") as f), LPAREN when before place 1 = RPAREN ->
    Some ("unexpected ':'", Printf.sprintf "parentheses behind %s hold all its pairs: %s" f (call f))
  | COLON, (NAME "execute" | COMMAND "execute"), _ when opener < first && before place 2 = BAR ->
    Some ("unexpected ':'",
          Printf.sprintf "the tasks of other vehicles follow a ',': execute v: T, %s: U"
            (text_of place (place.index - 1)))
  | COLON, (NAME "execute" | COMMAND "execute"), _ when before place 1 = RBRACKET || before place 1 = RPAREN ->
    Some ("unexpected ':'", "before a ':' stands a name: give these vehicles one, or write execute (task)[vehicles]")
  | _ -> None

(* [pause 5 mins]. *)
let misspelt_units = [
  "mins", "min"; "secs", "sec"; "s", "sec"; "msec", "ms"; "hrs", "hours"; "h", "hours"; "kms", "km"; "deg", "degrees";
  "kn", "knots"; "kt", "knots"; "kts", "knots"; "ft", "feet"; "nm", "nauticalMiles"; "NM", "nauticalMiles";
  "nmi", "nauticalMiles";
]

let is_unit x = List.mem_assoc x misspelt_units || Units.factor x <> None

let follows_number place = match before place 1 with INTEGER _ | NUMBER _ -> true | _ -> false

(* Whether the place is directly in the braces of a builder, [imcPlan { ... }], but not within an argument there. *)
let is_setting place =
  let opener = opener place in
  kind place opener = BLOCK && (match kind place (opener - 1) with BUILDER _ | RECRUIT -> true | _ -> false)

(* [task('a') when { poll a: 1 } then task('b')]. *)
let guard_behind place =
  match this place, kind place (statement place) with
  | WHEN, WHEN -> None
  | WHEN, _ when place.acceptable SEPARATOR ->
    Some ("unexpected 'when'",
          "a guard stands before its task: waitFor { ... } then TASK, or in oneOf and allOf when { ... } then TASK")
  | _, _ -> None

(* [x = 1 y = 2]. *)
let two_statements place =
  let begins =
    match this place, kind place (place.index + 1) with
    | NAME _, (ASSIGN | ASSIGN_OPERATOR _ | STEP _) -> true
    | NAME _, LPAREN -> is_setting place
    | COMMAND x, _ -> not (follows_number place && is_unit x)
    | (IF | WHILE | FOR | RETURN | BREAK | CONTINUE | DEF | WHEN), _ -> true
    | _, _ -> false
  in
  if begins && place.acceptable SEPARATOR && not (place.acceptable (INTEGER 0)) then
    Some (Printf.sprintf "unexpected %s" (spelt place place.index), "a ';' or a new line is missing before it")
  else None

(* What follows the name makes it another thing than a unit. *)
let is_more_than_unit place =
  match kind place (place.index + 1) with LPAREN | LBRACKET | DOT | SHIFT_LEFT | COLON -> true | _ -> false

let unit_without_point place =
  match this place with
  | (NAME x | COMMAND x)
    when follows_number place && place.acceptable PLUS && (is_unit x || not (is_more_than_unit place)) ->
    let unit = Option.value (List.assoc_opt x misspelt_units) ~default:x in
    Some (Printf.sprintf "unexpected %s" (spelt place place.index),
          Printf.sprintf "a unit stands behind a point: %s.%s" (text_of place (place.index - 1)) unit)
  | _ -> None

(* [30%]. *)
let percent_sign place =
  match before place 2, before place 1 with
  | (INTEGER _ | NUMBER _), PERCENT ->
    Some (Printf.sprintf "unexpected %s" (spelt place place.index),
          Printf.sprintf "a share is written %s.percent" (text_of place (place.index - 2)))
  | _ -> None

(* [parameter n = 3, how many]. *)
let described_parameter place =
  match kind place (statement place), this place with
  | PARAMETER, (NAME _ | COMMAND _ | STRING _ | TEMPLATE_OPEN | INTEGER _ | NUMBER _) ->
    Some (Printf.sprintf "unexpected %s" (spelt place place.index),
          "a parameter's value may be followed by a ',' and a description in quotes: parameter n = 3, 'how many'")
  | _ -> None

let stray place =
  match this place, before place 1 with
  | (LBRACE | TRAILING), (STRING _ | TEMPLATE_CLOSE | INTEGER _ | NUMBER _) ->
    Some ("unexpected '{'", "a ',' is missing before it")
  | COMMA, _ when opener place < 0 || kind place (opener place) <> LPAREN && kind place (opener place) <> LBRACKET ->
    Some ("unexpected ','", "only arguments and elements are separated by ','")
  | COLON, _ -> Some ("unexpected ':'", "before a ':' stands a name or a text: key: value")
  | SEPARATOR, _ when spelt place place.index = "';'" && not (place.acceptable (INTEGER 0)) ->
    Some ("unexpected ';'", "a ')' or a ']' is missing before it")
  | (NAME _ | COMMAND _ | BUILDER _ | INTEGER _ | NUMBER _ | STRING _ | TEMPLATE_OPEN), _
    when place.acceptable PLUS && place.acceptable SEPARATOR ->
    Some (Printf.sprintf "unexpected %s" (spelt place place.index),
          "an operator or a ',' is missing before it, or a new line")
  | (NAME _ | COMMAND _ | BUILDER _ | INTEGER _ | NUMBER _ | STRING _ | TEMPLATE_OPEN), _
    when place.acceptable PLUS && place.acceptable COMMA ->
    Some (Printf.sprintf "unexpected %s" (spelt place place.index), "an operator or a ',' is missing before it")
  | _ -> None

(* [repeat a until { C } >> b]. *)
let after_rounds place =
  if place.acceptable NEVER then
    let operator = text_of place (place.index - 1) in
    Some (Printf.sprintf "the task that the 'until' before this '%s' ends is ambiguous" operator,
          Printf.sprintf
            "write (repeat task until { condition }) %s other, or repeat (task until { condition }) %s other"
            operator operator)
  else None

(* [{ task('a') } >> b] at the beginning of a statement, which the brace ends. *)
let task_in_braces place =
  let last = if before place 1 = SEPARATOR then place.index - 2 else place.index - 1 in
  let is_block () =
    let opener = opener { place with index = last } in
    kind place last = RBRACE && kind place opener = BLOCK && statement { place with index = opener } = opener
  in
  match this place with
  | (SHIFT_RIGHT | BAR) when is_block () ->
    let operator = text_of place place.index in
    let hint =
      Printf.sprintf
        "a '{' at the beginning of a statement opens a block; a task stands in parentheses: (task) %s ..." operator
    in
    Some (Printf.sprintf "unexpected '%s'" operator, hint)
  | _ -> None

let rules = [
  after_rounds; task_in_braces; missing_parenthesis; missing_block; assigned_word; missing_brace;
  missing_parameters; negative_argument; greedy_bracket; assignment; missing_word; misplaced_word; command;
  guard_behind; two_statements; unit_without_point; percent_sign; described_parameter; stray;
]

let fault ~source ~tokens ~index ~acceptable =
  let place = { source; tokens; index; acceptable } in
  let message, hint =
    match List.find_map (fun rule -> rule place) rules with
    | Some (message, hint) -> message, Some hint
    | None ->
      let hint = Option.map (fun expected -> expected ^ " is expected here") (expected place) in
      Printf.sprintf "unexpected %s" (spelt place index), hint
  in
  let at =
    match kind place index with
    | EOF when index > 0 ->
      let last = tokens.(index - 1).stop in
      Location.make (last, last)
    | _ when index > 0 && acceptable NEVER -> Token.at tokens.(index - 1)
    | _ -> Token.at tokens.(index)
  in
  Diagnostic.error ?hint at message
