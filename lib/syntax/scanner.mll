{
open Grammar

type raw = { tokens : Token.t list; faults : Diagnostic.t list }

(* A string under way. *)
type text = {
  quote : char;
  triple : bool;
  opening : Lexing.position;
  opening_end : Lexing.position;
  newline_before : bool;
  buffer : Buffer.t;
  mutable chunk : Lexing.position;     (* the beginning of the text in [buffer] *)
  mutable holed : bool;                (* whether TEMPLATE_OPEN is out *)
}

(* The constructs around the place of reading: strings, and the holes in them. *)
type mode =
  | Text of text
  | Hole of { mutable depth : int }    (* the brackets open within the hole *)

type state = {
  cursor : Cursor.t;
  mutable modes : mode list;
  mutable newline : bool;
  mutable reversed : Token.t list;
  mutable faults_reversed : Diagnostic.t list;
  mutable finished : bool;
}

let first lexbuf = lexbuf.Lexing.lex_start_pos
let last lexbuf = lexbuf.Lexing.lex_curr_pos

let push state token start stop =
  state.reversed <- { Token.token; start; stop; newline = state.newline } :: state.reversed;
  state.newline <- false

(* The place of the token from [before] bytes ahead of the match. *)
let place ?(before = 0) state lexbuf =
  let start = Cursor.position state.cursor (first lexbuf - before) in
  start, Cursor.position state.cursor (last lexbuf)

let emit state lexbuf token =
  let start, stop = place state lexbuf in
  push state token start stop

let fault state ?hint at message =
  state.faults_reversed <- Diagnostic.error ?hint (Location.make at) message :: state.faults_reversed

(* A token that is read as if it were spelt right. *)
let mended state lexbuf token ~hint message =
  let start, stop = place state lexbuf in
  fault state (start, stop) message ~hint;
  push state token start stop

let keywords = Hashtbl.of_seq (List.to_seq Words.tokens)

let words =
  let reserved = List.filter Construct.is_reserved Construct.words in
  List.sort String.compare (List.map (fun (word : Construct.word) -> word.spelling) reserved)

let word text =
  match Hashtbl.find_opt keywords text with
  | Some token -> token
  | None -> NAME text

(* {1 Numbers} *)

let integer state lexbuf text =
  let start, stop = place state lexbuf in
  match int_of_string_opt text with
  | Some n when n >= 0 -> push state (INTEGER n) start stop
  | Some _ | None ->
    fault state (start, stop) (Printf.sprintf "the number %s is too large" text)
      ~hint:(Printf.sprintf "the largest whole number is %d" max_int);
    push state (INTEGER 0) start stop

let number state lexbuf text =
  let start, stop = place state lexbuf in
  match float_of_string_opt text with
  | Some x when Float.is_finite x -> push state (NUMBER x) start stop
  | Some _ | None ->
    fault state (start, stop) (Printf.sprintf "the number %s is too large" text);
    push state (NUMBER 0.) start stop

(* A number with a name stuck to it, [5km]. *)
let number_and_name state lexbuf digits =
  let text = Lexing.lexeme lexbuf in
  let name = String.sub text (String.length digits) (String.length text - String.length digits) in
  mended state lexbuf (INTEGER 0) (Printf.sprintf "'%s' is neither a number nor a name" text)
    ~hint:(Printf.sprintf "a unit follows after a point: %s.%s" digits name)

(* {1 Strings} *)

let open_text state lexbuf quote triple =
  let opening, opening_end = place state lexbuf in
  let text =
    { quote; triple; opening; opening_end; newline_before = state.newline; buffer = Buffer.create 32;
      chunk = opening_end; holed = false } in
  state.newline <- false;
  state.modes <- Text text :: state.modes

(* Hands on the text read since the last hole, up to [stop]. *)
let flush state text stop =
  if not text.holed then begin
    text.holed <- true;
    state.newline <- text.newline_before;
    push state TEMPLATE_OPEN text.opening text.opening_end
  end;
  if Buffer.length text.buffer > 0 then push state (TEXT (Buffer.contents text.buffer)) text.chunk stop;
  Buffer.clear text.buffer

let close_text state text start stop =
  if text.holed then begin
    flush state text start;
    push state TEMPLATE_CLOSE start stop
  end
  else begin
    state.newline <- text.newline_before;
    push state (STRING (Buffer.contents text.buffer)) text.opening stop
  end

(* Closes all that is open, for a string that does not end. *)
let rec abandon state stop =
  match state.modes with
  | [] -> ()
  | mode :: modes ->
    state.modes <- modes;
    begin match mode with
      | Text text -> close_text state text stop stop
      | Hole _ -> push state HOLE_CLOSE stop stop
    end;
    abandon state stop

let rec innermost_text = function
  | Text text :: _ -> Some text
  | Hole _ :: modes -> innermost_text modes
  | [] -> None

let quotes text = String.make (if text.triple then 3 else 1) text.quote

let unterminated state offset =
  let stop = Cursor.position state.cursor offset in
  begin match innermost_text state.modes, state.modes with
    | None, _ -> ()
    (* In ["a ${x"] the second quote is more likely meant to close than to open. *)
    | Some _, Text { triple = false; _ } :: Hole _ :: Text ({ triple = false; _ } as text) :: _
    | Some text, Hole _ :: _ ->
      fault state (text.opening, stop) "the hole '${' in this string is never closed" ~hint:"close it with '}'"
    | Some text, (Text _ :: _ | []) ->
      let hint =
        if text.triple then Printf.sprintf "close it with %s" (quotes text)
        else
          Printf.sprintf "close it with %s on the same line, or write %s around a text of several lines"
            (quotes text) (String.make 3 text.quote) in
      fault state (text.opening, if text.triple then text.opening_end else stop) "this string is never closed" ~hint
  end;
  abandon state stop

let open_hole state text start stop =
  flush state text start;
  push state HOLE_OPEN start stop

(* The tokens of the hole [$name.x.y], which starts at byte [offset]. *)
let short_hole state text offset path =
  let at = Cursor.position state.cursor in
  let start = at offset in
  open_hole state text start (at (offset + 1));
  let rec names offset = function
    | [] -> offset
    | name :: rest ->
      let start = at offset in
      let next = offset + String.length name in
      let stop = at next in
      push state (if name = "_" then WILDCARD else NAME name) start stop;
      if rest = [] then next
      else begin
        push state DOT stop (at (next + 1));
        names (next + 1) rest
      end
  in
  let stop = at (names (offset + 1) (String.split_on_char '.' path)) in
  push state HOLE_CLOSE stop stop;
  text.chunk <- stop

let add_character buffer code = Buffer.add_utf_8_uchar buffer (Uchar.of_int code)

(* {1 Brackets within holes} *)

let deeper state by =
  match state.modes with
  | Hole hole :: _ -> hole.depth <- max 0 (hole.depth + by)
  | Text _ :: _ | [] -> ()

let close_brace state lexbuf =
  match state.modes with
  | Hole { depth = 0 } :: modes ->
    let start, stop = place state lexbuf in
    state.modes <- modes;
    push state HOLE_CLOSE start stop;
    begin match modes with
      | Text text :: _ -> text.chunk <- stop
      | Hole _ :: _ | [] -> ()
    end
  | (Hole _ | Text _) :: _ | [] ->
    deeper state (-1);
    emit state lexbuf RBRACE

(* Whether a line may not end here: in a hole of a string of one line, outside brackets. *)
let line_must_go_on state =
  match state.modes with
  | Hole { depth = 0 } :: Text { triple = false; _ } :: _ -> true
  | (Hole _ | Text _) :: _ | [] -> false
}

let blank = [' ' '\t' '\r' '\012']
let continuation = ['\x80'-'\xBF']

(* Letters beyond ASCII: U+00C0 to U+07FF without the two signs among them, and the scripts after U+0800,
   without the punctuation and the signs of U+2000 to U+303F. *)
let far_letter =
    '\xC3' ['\x80'-'\x96' '\x98'-'\xB6' '\xB8'-'\xBF']
  | ['\xC4'-'\xDF'] continuation
  | ['\xE0'-'\xE1'] continuation continuation
  | '\xE3' ['\x81'-'\xBF'] continuation
  | ['\xE4'-'\xEC'] continuation continuation
  | '\xED' ['\x80'-'\x9F'] continuation
let letter = ['a'-'z' 'A'-'Z' '_'] | far_letter
let name = letter (letter | ['0'-'9'])*
let digit = ['0'-'9']
let digits = digit (digit | '_')*
let exponent = ['e' 'E'] ['+' '-']? digit+
let decimal = digits '.' digit (digit | '_')* exponent? | digits exponent
let hex = ['0'-'9' 'a'-'f' 'A'-'F']
let typographic_single = "\xE2\x80" ['\x98'-'\x9B']
let typographic_double = "\xE2\x80" ['\x9C'-'\x9F']
let character = ['\x00'-'\x7F'] | ['\xC0'-'\xFF'] continuation*

rule code state = parse
  | blank+ { () }
  | '\n' {
      if line_must_go_on state then unterminated state (first lexbuf);
      state.newline <- true }
  | "//" [^ '\n']* { () }
  | "/*" { comment state (place state lexbuf) lexbuf }
  | "#!" [^ '\n']* {
      if first lexbuf > 3 then
        fault state (place state lexbuf) "unexpected '#!'" ~hint:"a comment starts with '//'" }
  | eof {
      if state.modes <> [] then unterminated state (first lexbuf);
      emit state lexbuf EOF;
      state.finished <- true }
  | name as text { emit state lexbuf (word text) }
  | digits as text { integer state lexbuf text }
  | (digits as text) ['g' 'G' 'l' 'L' 'i' 'I'] { integer state lexbuf text }
  | "0x" hex+ as text { integer state lexbuf text }
  | decimal as text { number state lexbuf text }
  | (decimal | digits as text) ['f' 'F' 'd' 'D'] { number state lexbuf text }
  | (decimal as text) ['g' 'G'] { number state lexbuf text }
  | (digits | digits '.' digits as number) name { number_and_name state lexbuf number }
  | "'''" { open_text state lexbuf '\'' true }
  | "\"\"\"" { open_text state lexbuf '"' true }
  | '\'' { open_text state lexbuf '\'' false }
  | '"' { open_text state lexbuf '"' false }
  | (typographic_single | typographic_double) as mark { typographic state mark lexbuf }
  | '(' { deeper state 1; emit state lexbuf LPAREN }
  | ')' { deeper state (-1); emit state lexbuf RPAREN }
  | '[' { deeper state 1; emit state lexbuf LBRACKET }
  | ']' { deeper state (-1); emit state lexbuf RBRACKET }
  | '{' { deeper state 1; emit state lexbuf LBRACE }
  | '}' { close_brace state lexbuf }
  | ';' { emit state lexbuf SEPARATOR }
  | ',' { emit state lexbuf COMMA }
  | ':' { emit state lexbuf COLON }
  | "->" { emit state lexbuf ARROW }
  | '.' { emit state lexbuf DOT }
  | "?." { emit state lexbuf SAFE_DOT }
  | '?' { emit state lexbuf QUESTION }
  | "?:" { emit state lexbuf ELVIS }
  | '=' { emit state lexbuf ASSIGN }
  | "+=" { emit state lexbuf (ASSIGN_OPERATOR Ast.Add) }
  | "-=" { emit state lexbuf (ASSIGN_OPERATOR Ast.Subtract) }
  | "*=" { emit state lexbuf (ASSIGN_OPERATOR Ast.Multiply) }
  | "/=" { emit state lexbuf (ASSIGN_OPERATOR Ast.Divide) }
  | "%=" { emit state lexbuf (ASSIGN_OPERATOR Ast.Remainder) }
  | "++" { emit state lexbuf (STEP 1) }
  | "--" { emit state lexbuf (STEP (-1)) }
  | ".." { emit state lexbuf RANGE }
  | "..<" { emit state lexbuf RANGE_LESS }
  | "**" { emit state lexbuf POWER }
  | '*' { emit state lexbuf STAR }
  | '/' { emit state lexbuf SLASH }
  | '%' { emit state lexbuf PERCENT }
  | '+' { emit state lexbuf PLUS }
  | '-' { emit state lexbuf MINUS }
  | "<<" { emit state lexbuf SHIFT_LEFT }
  | ">>" { emit state lexbuf SHIFT_RIGHT }
  | '<' { emit state lexbuf LESS }
  | "<=" { emit state lexbuf LESS_EQUAL }
  | '>' { emit state lexbuf GREATER }
  | ">=" { emit state lexbuf GREATER_EQUAL }
  | "==" { emit state lexbuf EQUAL }
  | "!=" { emit state lexbuf NOT_EQUAL }
  | '&' { emit state lexbuf AMPERSAND }
  | '^' { emit state lexbuf CARET }
  | '|' { emit state lexbuf BAR }
  | "&&" { emit state lexbuf AND }
  | "||" { emit state lexbuf OR }
  | '!' { emit state lexbuf NOT }
  | "===" { mended state lexbuf EQUAL "unknown operator '==='" ~hint:"write '=='" }
  | "!==" { mended state lexbuf NOT_EQUAL "unknown operator '!=='" ~hint:"write '!='" }
  | "<=>" { mended state lexbuf LESS "unknown operator '<=>'" ~hint:"sort by a key: xs.sort { x -> x.battery }" }
  | ("==~" | "=~") as text {
      mended state lexbuf EQUAL (Printf.sprintf "unknown operator '%s'" text)
        ~hint:"texts have startsWith(s), endsWith(s) and contains(s)" }
  | "?=" { mended state lexbuf ASSIGN "unknown operator '?='" ~hint:"write x = x ?: value" }
  | "*." { mended state lexbuf DOT "unknown operator '*.'" ~hint:"write xs.collect { it.name }" }
  | "!in" blank { mended state lexbuf IN "unknown operator '!in'" ~hint:"write !(x in xs)" }
  | '.' digits as text {
      mended state lexbuf (NUMBER 0.) "a number begins with a digit" ~hint:(Printf.sprintf "write 0%s" text) }
  | "=>" { mended state lexbuf ARROW "unknown operator '=>'" ~hint:"write '->' after parameters, '>=' to compare" }
  | "\xC2\xA0" { fault state (place state lexbuf) "a no-break space stands here" ~hint:"put an ordinary space" }
  | "\xE2\x80" ['\x90'-'\x95'] | "\xE2\x88\x92" {
      mended state lexbuf MINUS "a typographic dash is not a minus sign" ~hint:"write '-'" }
  | "\xE2\x86\x92" { mended state lexbuf ARROW "a typographic arrow stands here" ~hint:"write '->'" }
  | character as text {
      let hint =
        match text with
        | "#" -> Some "a comment starts with '//'"
        | "\\" -> Some "a line that ends with an operator or a comma goes on by itself"
        | "$" -> Some "'$' starts a hole in a text between double quotes, and nothing else"
        | "`" | "\xC2\xB4" -> Some "write ' around a text"
        | _ -> None in
      let shown = if Char.code text.[0] < 0x20 || text = "\x7F" then String.escaped text else text in
      fault state (place state lexbuf) (Printf.sprintf "unexpected character '%s'" shown) ?hint }
  | _ { fault state (place state lexbuf) "a byte that is not text stands here" }

and comment state opening = parse
  | "*/" { () }
  | '\n' { state.newline <- true; comment state opening lexbuf }
  | [^ '*' '\n']+ | '*' { comment state opening lexbuf }
  | eof { fault state opening "this comment is never closed" ~hint:"close it with '*/'" }

(* A text between typographic quotes, after the first: read as if the quotes were plain. *)
and typographic state mark = parse
  | (([^ '\n' '\xE2' '\'' '"']* as text) (typographic_single | typographic_double | '\'' | '"'))? {
      let opening = String.length mark in
      let start, _ = place state lexbuf ~before:opening in
      let mark_end = { start with Lexing.pos_cnum = start.Lexing.pos_cnum + opening;
                                  pos_bol = start.Lexing.pos_bol + opening - 1 } in
      let plain = if mark.[2] <= '\x9B' then "'" else "\"" in
      fault state (start, mark_end) (Printf.sprintf "%s is a typographic quote" mark)
        ~hint:(Printf.sprintf "write %s" plain);
      let _, stop = place state lexbuf in
      Option.iter (fun text -> push state (STRING text) start stop) text }

(* The inside of a string, up to its end or to a hole. *)
and text state it = parse
  | [^ '\\' '$' '\'' '"' '\n' '\r']+ as plain { Buffer.add_string it.buffer plain; text state it lexbuf }
  | '\r' { text state it lexbuf }
  | '\n' {
      if it.triple then begin
        Buffer.add_char it.buffer '\n';
        text state it lexbuf
      end
      else begin
        unterminated state (first lexbuf);
        state.newline <- true
      end }
  | '\'' | '"' {
      let quote = Lexing.lexeme_char lexbuf 0 in
      let offset = first lexbuf in
      let again i =
        offset + i < lexbuf.Lexing.lex_buffer_len && Bytes.get lexbuf.Lexing.lex_buffer (offset + i) = quote in
      if quote <> it.quote || it.triple && not (again 1 && again 2) then begin
        Buffer.add_char it.buffer quote;
        text state it lexbuf
      end
      else begin
        if it.triple then lexbuf.Lexing.lex_curr_pos <- offset + 3;
        let start, stop = place state lexbuf in
        state.modes <- List.tl state.modes;
        close_text state it start stop
      end }
  | "${" {
      if it.quote = '"' then begin
        let start, stop = place state lexbuf in
        open_hole state it start stop;
        state.modes <- Hole { depth = 0 } :: state.modes
      end
      else begin
        Buffer.add_string it.buffer "${";
        text state it lexbuf
      end }
  | '$' (name ('.' name)* as path) {
      if it.quote = '"' then short_hole state it (first lexbuf) path
      else begin
        Buffer.add_char it.buffer '$';
        Buffer.add_string it.buffer path
      end;
      text state it lexbuf }
  | '$' { Buffer.add_char it.buffer '$'; text state it lexbuf }
  | '\\' { escape state it lexbuf; text state it lexbuf }
  | eof { unterminated state (first lexbuf) }

and escape state it = parse
  | 'n' { Buffer.add_char it.buffer '\n' }
  | 't' { Buffer.add_char it.buffer '\t' }
  | 'r' { Buffer.add_char it.buffer '\r' }
  | 'b' { Buffer.add_char it.buffer '\b' }
  | 'f' { Buffer.add_char it.buffer '\012' }
  | ['\\' '\'' '"' '$'] as c { Buffer.add_char it.buffer c }
  | '\r'? '\n' {
      (* A line of a long text that goes on; a short text cannot. *)
      if not it.triple then lexbuf.Lexing.lex_curr_pos <- first lexbuf }
  | 'u' (['d' 'D'] ['8'-'9' 'a'-'b' 'A'-'B'] hex hex as high) "\\u" (['d' 'D'] ['c'-'f' 'C'-'F'] hex hex as low) {
      let value text = int_of_string ("0x" ^ text) in
      add_character it.buffer (0x10000 + ((value high - 0xD800) lsl 10) + (value low - 0xDC00)) }
  | 'u' (hex hex hex hex as code) {
      let code = int_of_string ("0x" ^ code) in
      if Uchar.is_valid code then add_character it.buffer code
      else
        fault state (place state lexbuf ~before:1) "half of a surrogate pair is not a character"
          ~hint:"write both halves: \\ud83d\\udc2c" }
  | 'u' {
      fault state (place state lexbuf ~before:1) "'\\u' needs four hexadecimal digits" ~hint:"such as \\u00e9" }
  | character as text {
      Buffer.add_string it.buffer text;
      fault state (place state lexbuf ~before:1) (Printf.sprintf "'\\%s' stands for nothing in a string" text)
        ~hint:"write \\\\ for a backslash; there are \\n \\t \\r \\\\ \\' \\\" \\$ and \\uXXXX" }
  | eof | _ { () }

{
let scan ~file source =
  let lexbuf = Lexing.from_string ~with_positions:false source in
  let mark = "\xEF\xBB\xBF" in
  if String.length source >= 3 && String.sub source 0 3 = mark then lexbuf.Lexing.lex_curr_pos <- 3;
  let state =
    { cursor = Cursor.make ~file source; modes = []; newline = false; reversed = []; faults_reversed = [];
      finished = false } in
  while not state.finished do
    match state.modes with
    | Text it :: _ -> text state it lexbuf
    | Hole _ :: _ | [] -> code state lexbuf
  done;
  { tokens = List.rev state.reversed; faults = List.rev state.faults_reversed }
}
