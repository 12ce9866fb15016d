type role = Watches | Answers | Steers
type operator = { name : string option; role : role; token : string }

let ( let* ) = Result.bind

let secret () =
  let channel = open_in_bin "/dev/urandom" in
  Digest.to_hex (Fun.protect ~finally:(fun () -> close_in channel) (fun () -> really_input_string channel 16))

let anonymous () =
  [ { name = None; role = Steers; token = secret () }; { name = None; role = Watches; token = secret () } ]

let role_word = function Watches -> "watch" | Answers -> "answer" | Steers -> "steer"
let role_name = function Watches -> "watches" | Answers -> "answers" | Steers -> "steers"

(* {1 The file} *)

let is_plain c = match c with 'a' .. 'z' | 'A' .. 'Z' | '0' .. '9' | '-' | '_' -> true | _ -> false
let is_name text = text <> "" && String.length text <= 32 && String.for_all is_plain text
let is_token text = String.length text >= 16 && String.length text <= 128 && String.for_all is_plain text

let role = function
  | "watch" -> Ok Watches
  | "answer" -> Ok Answers
  | "steer" -> Ok Steers
  | other -> Error (Printf.sprintf "'%s' is not a role: watch, answer or steer" (String.escaped other))

let words line =
  let text = match String.index_opt line '#' with Some i -> String.sub line 0 i | None -> line in
  let blank c = if c = '\t' || c = '\r' then ' ' else c in
  List.filter (( <> ) "") (String.split_on_char ' ' (String.map blank text))

let operator line =
  let make name as_ token =
    let* role = role as_ in
    if not (is_name name) then
      Error (Printf.sprintf "'%s' is not a name: 1 to 32 letters, digits, dashes and underscores" (String.escaped name))
    else if not (is_token token) then Error "a token has 16 to 128 letters, digits, dashes and underscores"
    else Ok (Some { name = Some name; role; token })
  in
  match words line with
  | [] -> Ok None
  | [ name; as_ ] -> make name as_ (secret ())
  | [ name; as_; token ] -> make name as_ token
  | _ -> Error "a line has a name, a role, and perhaps a token"

let rec is_twice f = function
  | [] -> None
  | x :: rest -> if List.exists (fun y -> f x = f y) rest then Some x else is_twice f rest

let read text =
  let numbered number line = Result.map_error (Printf.sprintf "line %d: %s" (number + 1)) (operator line) in
  let rec all number = function
    | [] -> Ok []
    | line :: rest ->
      let* found = numbered number line in
      let* others = all (number + 1) rest in
      Ok (match found with Some o -> o :: others | None -> others)
  in
  let* found = all 0 (String.split_on_char '\n' text) in
  match found, is_twice (fun o -> o.name) found, is_twice (fun o -> o.token) found with
  | [], _, _ -> Error "there are no operators"
  | _, Some o, _ -> Error (Printf.sprintf "the name %s is there twice" (Option.value o.name ~default:""))
  | _, None, Some _ -> Error "two operators have the same token"
  | found, None, None -> Ok found

let load path =
  let* text = Dolphin_app.Text_file.read path in
  let bad why = Error (Dolphin_app.Error.Bad_input (path ^ ": " ^ why)) in
  match Unix.stat path with
  | { st_perm; _ } when st_perm land 0o077 <> 0 -> bad "other users can read or write it, and it has tokens: chmod 600"
  | _ -> ( match read text with Ok found -> Ok found | Error why -> bad why)
  | exception Unix.Unix_error (error, _, _) -> bad (Unix.error_message error)
