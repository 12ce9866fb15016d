open Grammar
open Piece

let width = 120
let tab = 4

(* An argument stands below the first one of its command, unless that is farther than this from its line's start. *)
let farthest = 24

(* {1 Writing pieces} *)

(* A bracket that is open, or the whole text. *)
type frame = {
  statements : bool;                (* in braces; else a list, in parentheses *)
  indent : int;                     (* of the part that begins in it *)
  outer : int;                      (* of the line where it opened *)
  listed : bool;                    (* whether commas are in it *)
  mutable arguments : int option;   (* the column of the first argument of the statement's command *)
  mutable several : bool;           (* whether that argument has a name, or others follow it *)
}

type out = {
  pieces : Piece.t array;
  has_comma : bool array;           (* of each opening bracket *)
  buffer : Buffer.t;
  columns : int array;              (* after each piece *)
  mutable column : int;
  mutable line_indent : int;
  mutable frames : frame list;
  mutable line : int;               (* the piece that begins the line *)
  mutable long : (int * int) list;  (* lines beyond the width: their first piece, and the one after their last *)
  mutable is_long : bool;           (* whether this line is *)
}

let top = { statements = true; indent = 0; outer = 0; listed = false; arguments = None; several = false }
let frame out = match out.frames with [] -> top | frame :: _ -> frame

let characters text =
  String.fold_left (fun n c -> if Char.code c land 0xC0 = 0x80 then n else n + 1) 0 text

let put out text =
  Buffer.add_string out.buffer text;
  match String.rindex_opt text '\n' with
  | None -> out.column <- out.column + characters text
  | Some last -> out.column <- characters (String.sub text (last + 1) (String.length text - last - 1))

let end_line out =
  put out "\n";
  out.column <- 0

let begin_line out ~blank indent =
  end_line out;
  if blank then end_line out;
  put out (String.make indent ' ');
  out.line_indent <- indent

(* How far a line that begins with piece [i] is indented. *)
let indentation out i =
  let piece = out.pieces.(i) and frame = frame out in
  let before = if i = 0 then SEPARATOR else out.pieces.(i - 1).token in
  let after_comma = before = COMMA in
  match piece.token with
  | RPAREN | RBRACKET | RBRACE -> frame.outer
  | EOF -> 0
  | ELSE -> frame.indent
  | _ when piece.starts -> frame.indent
  | _ when frame.statements ->
    (match frame.arguments with
     | Some column when frame.several -> if after_comma then column else column + tab
     | Some _ | None -> frame.indent + tab)
  | _ -> if after_comma || out.pieces.(i - 1).partner >= i || not frame.listed then frame.indent else frame.indent + tab

(* Comments before the end of a body stand as its statements do. *)
let comment_indentation out i =
  match out.pieces.(i).token with
  | RPAREN | RBRACKET | RBRACE -> (frame out).indent
  | _ -> indentation out i

let opens i piece = piece.partner > i
let is_opening out i = i < 0 || opens i out.pieces.(i) || out.pieces.(i).token = ARROW

let comment out i ~first (c : comment) =
  if c.fresh && i = 0 && first then put out c.text
  else begin
    if c.fresh then begin
      let blank = c.after_blank && not (first && is_opening out (i - 1)) in
      begin_line out ~blank (comment_indentation out i)
    end
    else if first && i > 0 && (match out.pieces.(i - 1).token with LPAREN | LBRACKET -> true | _ -> false) then ()
    else put out " ";
    put out c.text
  end

(* Ends the line before piece [i], or leaves a blank, as they should be. *)
let lead out i =
  let piece = out.pieces.(i) in
  List.iteri (fun k c -> comment out i ~first:(k = 0) c) piece.comments;
  let after_comment = piece.comments <> [] in
  let beside_comment =
    match List.rev piece.comments with
    | last :: _ -> last.fresh && not piece.detached
    | [] -> false in
  let closes = match piece.token with RPAREN | RBRACKET | RBRACE | EOF -> true | _ -> false in
  if i = 0 && not after_comment then ()
  else if (piece.breaks || (i = 0 && piece.detached)) && not beside_comment then begin
    let blank = piece.after_blank && not closes && (after_comment || not (is_opening out (i - 1))) in
    begin_line out ~blank (indentation out i)
  end
  else if after_comment then
    put out (match piece.token with COMMA | RPAREN | RBRACKET -> "" | _ -> " ")
  else if Spacing.before out.pieces i then put out " "

(* Whether a semicolon stands before piece [i]: between statements on one line, and in [pick; { ... }], where the
   brace would else belong to the name. *)
let follows_semicolon out i =
  i > 0 && out.pieces.(i).starts
  && match out.pieces.(i - 1).token with
  | LBRACE | TRAILING | BLOCK | ARROW -> false
  | NAME x when out.pieces.(i).token = BLOCK && Layout.builder x <> None -> true
  | _ -> not out.pieces.(i).breaks

let remember out i =
  let piece = out.pieces.(i) and frame = frame out in
  if piece.starts then begin
    frame.arguments <- None;
    frame.several <- false
  end;
  if piece.token = COMMA || (piece.token = COLON && not piece.ternary) then frame.several <- true;
  match out.pieces.(max 0 (i - 1)).token with
  | COMMAND _ when i > 0 && frame.statements && frame.arguments = None
                   && out.column - out.line_indent <= farthest -> frame.arguments <- Some out.column
  | _ -> ()

let first_line text =
  match String.index_opt text '\n' with
  | Some n -> String.sub text 0 n
  | None -> text

let write out i =
  let piece = out.pieces.(i) in
  if follows_semicolon out i then put out ";";
  let is_first = piece.breaks && i > 0 in
  if is_first then begin
    if out.is_long then out.long <- (out.line, i) :: out.long;
    out.is_long <- false;
    out.line <- i
  end;
  lead out i;
  (match piece.token with
   | RPAREN | RBRACKET | RBRACE -> out.frames <- (match out.frames with [] -> [] | _ :: rest -> rest)
   | _ -> ());
  remember out i;
  if out.column + characters (first_line piece.text) > width then out.is_long <- true;
  put out piece.text;
  out.columns.(i) <- out.column;
  if opens i piece then begin
    let statements = match piece.token with LBRACE | TRAILING | BLOCK -> true | _ -> false in
    out.frames <-
      { statements; indent = out.line_indent + tab; outer = out.line_indent; listed = out.has_comma.(i);
        arguments = None; several = false } :: out.frames
  end

let render pieces =
  let has_comma = Array.make (Array.length pieces) false in
  Array.iter (fun p -> if p.token = COMMA && p.enclosing >= 0 then has_comma.(p.enclosing) <- true) pieces;
  let out =
    { pieces; has_comma; buffer = Buffer.create 4096; columns = Array.make (Array.length pieces) 0; column = 0;
      line_indent = 0; frames = [ { top with arguments = None } ]; line = 0; long = []; is_long = false } in
  Array.iteri (fun i _ -> write out i) pieces;
  if out.is_long then out.long <- (out.line, Array.length pieces) :: out.long;
  out

(* Lines are ended until none is too long, or can be ended. *)
let rec rendered pieces =
  Line_breaks.settle pieces;
  let out = render pieces in
  let shorten (first, stop) = Line_breaks.shorten pieces ~columns:out.columns ~width ~first ~stop in
  if List.fold_left (fun any line -> shorten line || any) false out.long then rendered pieces
  else Buffer.contents out.buffer

let with_one_end text =
  let rec stop n = if n > 0 && (text.[n - 1] = '\n' || text.[n - 1] = ' ') then stop (n - 1) else n in
  match stop (String.length text) with
  | 0 -> ""
  | n -> String.sub text 0 n ^ "\n"

(* {1 Programs} *)

let layout ~file source =
  let { Scanner.tokens; faults = _ } = Scanner.scan ~file source in
  match Brackets.match_up (Array.of_list tokens) with
  | Result.Error _ -> source
  | Ok matched -> with_one_end (rendered (Piece.of_tokens ~source (Layout.arrange ~source matched)))

let arranged ~file source = Result.map (fun _ -> layout ~file source) (Parse.program ~file source)

let program ~file source =
  let same a b = Erase.program a = Erase.program b in
  Result.map
    (fun program ->
       let text = layout ~file source in
       match Parse.program ~file text with
       | Ok again when same program again -> text
       | Ok _ | Error _ -> source)
    (Parse.program ~file source)
