open Grammar

type comment = { text : string; fresh : bool; after_blank : bool }

type t = {
  token : Grammar.token;
  text : string;
  comments : comment list;
  detached : bool;
  after_blank : bool;
  set_apart : bool;
  starts : bool;
  ternary : bool;
  enclosing : int;
  depth : int;
  partner : int;
  mutable breaks : bool;
}

(* {1 Between two tokens} *)

let rec until_newline source i stop = if i < stop && source.[i] <> '\n' then until_newline source (i + 1) stop else i

let rec until_close source i stop =
  if i + 1 >= stop then stop
  else if source.[i] = '*' && source.[i + 1] = '/' then i + 2
  else until_close source (i + 1) stop

let rec trimmed_end text n = if n > 0 && String.contains " \t\r\012" text.[n - 1] then trimmed_end text (n - 1) else n

let without_returns text =
  if String.contains text '\r' then String.concat "" (String.split_on_char '\r' text) else text

(* Whether the line does not go on after it. *)
let ends_line (c : comment) = String.contains c.text '\n' || String.sub c.text 0 2 <> "/*"

(* The comments of [source] from [start] to [stop], and how many lines end after the last. *)
let gap source start stop =
  let starts_with i text =
    i + String.length text <= stop && String.sub source i (String.length text) = text in
  let rec go i lines comments =
    if i >= stop then List.rev comments, lines
    else if starts_with i "//" || starts_with i "#!" then comment i (until_newline source i stop) lines comments
    else if starts_with i "/*" then comment i (until_close source (i + 2) stop) lines comments
    else go (i + 1) (if source.[i] = '\n' then lines + 1 else lines) comments
  and comment i next lines comments =
    let text = String.sub source i (next - i) in
    let text = without_returns (String.sub text 0 (trimmed_end text (String.length text))) in
    go next 0 ({ text; fresh = lines > 0 || start = 0; after_blank = lines > 1 } :: comments)
  in
  go start 0 []

(* {1 Pieces} *)

(* The open brackets, the innermost first. *)
type opener = { index : int; mutable questions : int (* that wait for their colon *) }

(* The index of the token that closes the string with holes which opens at [i]. *)
let rec template_end (tokens : Token.t array) i depth =
  match tokens.(i).token with
  | TEMPLATE_OPEN -> template_end tokens (i + 1) (depth + 1)
  | TEMPLATE_CLOSE when depth = 1 -> i
  | TEMPLATE_CLOSE -> template_end tokens (i + 1) (depth - 1)
  | _ -> template_end tokens (i + 1) depth

let begins_body = function
  | SEPARATOR | LBRACE | TRAILING | BLOCK | ARROW -> true
  | _ -> false

(* Whether the name at [i], which follows a brace, is a parameter. *)
let rec is_parameter (tokens : Token.t array) i =
  match tokens.(i).token, tokens.(i + 1).token with
  | NAME _, COMMA -> is_parameter tokens (i + 2)
  | NAME _, ARROW | ARROW, _ -> true
  | _, _ -> false

let of_tokens ~source (tokens : Token.t array) =
  let top = { index = -1; questions = 0 } in
  let reversed = ref [] and count = ref 0 and openers = ref [ top ] and partners = Hashtbl.create 64 in
  let end_before = ref 0 and before = ref SEPARATOR in
  let add i (first : Token.t) (last : Token.t) token =
    let opener = match !openers with [] -> top | opener :: _ -> opener in
    let closes = match token with RPAREN | RBRACKET | RBRACE -> true | _ -> false in
    if closes then begin
      openers := (match !openers with [] -> [] | _ :: rest -> rest);
      Hashtbl.replace partners opener.index !count;
      Hashtbl.replace partners !count opener.index
    end;
    let starts =
      match token with
      | RBRACE | EOF -> false
      | _ -> begins_body !before && (!before = SEPARATOR || !before = ARROW || not (is_parameter tokens i)) in
    if starts || token = COMMA then opener.questions <- 0;
    let ternary = token = COLON && opener.questions > 0 in
    if token = QUESTION then opener.questions <- opener.questions + 1;
    if ternary then opener.questions <- opener.questions - 1;
    let start = first.start.pos_cnum and stop = last.stop.pos_cnum in
    let comments, lines = gap source !end_before start in
    (* A separator may stand between the end of that line and this token. *)
    let is_on_new_line = first.newline || List.exists ends_line comments in
    let enclosing = if closes then (match !openers with [] -> -1 | opener :: _ -> opener.index) else opener.index in
    let piece =
      { token; text = without_returns (String.sub source start (stop - start)); comments; detached = lines > 0;
        after_blank = lines > 1; set_apart = start > !end_before; starts; ternary; enclosing;
        depth = List.length !openers; partner = -1; breaks = is_on_new_line } in
    (match token with
     | LPAREN | LBRACKET | LBRACE | TRAILING | BLOCK -> openers := { index = !count; questions = 0 } :: !openers
     | _ -> ());
    reversed := piece :: !reversed;
    incr count;
    end_before := stop;
    before := token
  in
  let rec go i =
    if i < Array.length tokens then
      match tokens.(i).token with
      | SEPARATOR ->
        before := SEPARATOR;
        go (i + 1)
      | TEMPLATE_OPEN ->
        let last = template_end tokens i 0 in
        add i tokens.(i) tokens.(last) (STRING "");
        go (last + 1)
      | token ->
        add i tokens.(i) tokens.(i) token;
        go (i + 1)
  in
  go 0;
  let partner i piece = { piece with partner = Option.value (Hashtbl.find_opt partners i) ~default:(-1) } in
  Array.mapi partner (Array.of_list (List.rev !reversed))
