open Grammar

type t = { tokens : Token.t array; partner : int array; faults : Diagnostic.t list }

let limit = 1_000
let most_tokens = 500_000

type shape = Round | Square | Curly | Hole

type role = Opens of shape | Closes of shape | Neither

let role = function
  | LPAREN -> Opens Round
  | RPAREN -> Closes Round
  | LBRACKET -> Opens Square
  | RBRACKET -> Closes Square
  | LBRACE | TRAILING | BLOCK -> Opens Curly
  | RBRACE -> Closes Curly
  | HOLE_OPEN -> Opens Hole
  | HOLE_CLOSE -> Closes Hole
  | _ -> Neither

let opening = function Round -> "(" | Square -> "[" | Curly -> "{" | Hole -> "${"
let closing = function Round -> ")" | Square -> "]" | Curly | Hole -> "}"

let closing_token = function
  | Round -> RPAREN
  | Square -> RBRACKET
  | Curly -> RBRACE
  | Hole -> HOLE_CLOSE

(* An open bracket: its place in the result, and the indentation of its line. *)
type opener = { index : int; shape : shape; indentation : int; token : Token.t }

type state = {
  mutable reversed : (Token.t * int) list;    (* the result, each with its partner *)
  mutable count : int;
  mutable read : int;                         (* tokens and ends of lines *)
  mutable openers : opener list;
  mutable depth : int;
  mutable found : Diagnostic.t list;
  mutable indentation : int;                  (* of the line being read *)
  mutable suspect : opener option;            (* the first brace whose partner stands under another column *)
}

let column token = Location.column (Token.at token)

let add state token partner =
  state.reversed <- (token, partner) :: state.reversed;
  state.count <- state.count + 1

let fault state diagnostic = state.found <- diagnostic :: state.found

let pop state =
  match state.openers with
  | [] -> ()
  | _ :: rest ->
    state.openers <- rest;
    state.depth <- state.depth - 1

let unclosed state { shape; token; _ } =
  fault state
    (Diagnostic.error (Token.at token) (Printf.sprintf "this '%s' is never closed" (opening shape))
       ~hint:(Printf.sprintf "a '%s' is missing" (closing shape)))

(* Gives the innermost opener a missing partner, before [token]. *)
let supply state opener (token : Token.t) =
  add state { token with token = closing_token opener.shape; stop = token.start } opener.index;
  pop state

let close state shape (token : Token.t) starts_line =
  let rec closes_one = function
    | [] -> false
    | opener :: _ when opener.shape = shape -> true
    (* A parenthesis does not reach over an open brace, nor anything over a hole. *)
    | { shape = Curly; _ } :: _ when shape = Round || shape = Square -> false
    | { shape = Hole; _ } :: _ -> false
    | { shape = Round | Square | Curly; _ } :: rest -> closes_one rest
  in
  if closes_one state.openers then begin
    let rec close () =
      match state.openers with
      | [] -> ()
      | opener :: _ when opener.shape = shape ->
        if shape = Curly && starts_line && state.suspect = None && column token < opener.indentation then
          state.suspect <- Some opener;
        add state token opener.index;
        pop state
      | opener :: _ ->
        unclosed state opener;
        supply state opener token;
        close ()
    in
    close ()
  end
  else
    let hint =
      match state.openers with
      | opener :: _ ->
        Printf.sprintf "the '%s' of line %d is still open; nothing opens this one" (opening opener.shape)
          (Token.line opener.token)
      | [] -> Printf.sprintf "no '%s' is open here" (opening shape)
    in
    fault state (Diagnostic.error (Token.at token) (Printf.sprintf "unexpected '%s'" (closing shape)) ~hint)

(* Closes at the end what is open. Of a brace that is never closed, the first one whose supposed partner stood
   to the left of it is more likely the culprit. *)
let finish state token =
  let rec go () =
    match state.openers with
    | [] -> ()
    | opener :: _ ->
      let culprit =
        match opener.shape, state.suspect with
        | Curly, Some suspect when suspect.index > opener.index ->
          state.suspect <- None;
          suspect
        | (Curly | Round | Square | Hole), (Some _ | None) -> opener in
      unclosed state culprit;
      supply state opener token;
      go ()
  in
  go ()

exception Too_deep of Token.t
exception Too_many of Token.t

let step state (token : Token.t) =
  let starts_line = token.newline || state.count = 0 in
  if starts_line then state.indentation <- column token;
  (* A line's end is as good as a ';'. *)
  state.read <- state.read + if token.newline then 2 else 1;
  if state.read > most_tokens then raise (Too_many token);
  match role token.token with
  | Opens shape ->
    if state.depth >= limit then raise (Too_deep token);
    let opener = { index = state.count; shape; indentation = state.indentation; token } in
    add state token (-1);
    state.openers <- opener :: state.openers;
    state.depth <- state.depth + 1
  | Closes shape -> close state shape token starts_line
  | Neither ->
    if token.token = EOF then finish state token;
    add state token (-1)

let match_up tokens =
  let state =
    { reversed = []; count = 0; read = 0; openers = []; depth = 0; found = []; indentation = 1; suspect = None } in
  match Array.iter (step state) tokens with
  | () ->
    let result = Array.of_list (List.rev state.reversed) in
    let partner = Array.map snd result in
    Array.iteri (fun i opener -> if opener >= 0 then partner.(opener) <- i) (Array.map snd result);
    Ok { tokens = Array.map fst result; partner; faults = List.sort Diagnostic.compare state.found }
  | exception Too_deep token ->
    Error
      (Diagnostic.error (Token.at token) (Printf.sprintf "brackets nest deeper than %d here" limit)
         ~hint:"give the inner parts names")
  | exception Too_many token ->
    Error
      (Diagnostic.error (Token.at token)
         (Printf.sprintf "the program has more than %d words and signs up to here" most_tokens)
         ~hint:"programs are written by people: compute large data in the program, or pass it as inputs")
