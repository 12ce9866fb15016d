type role = Watches | Answers | Steers
type operator = { name : string option; role : role; admin : bool; duties : string list; token : string }

let ( let* ) = Result.bind

let secret () =
  let channel = open_in_bin "/dev/urandom" in
  Digest.to_hex (Fun.protect ~finally:(fun () -> close_in channel) (fun () -> really_input_string channel 16))

let anonymous () =
  let make role = { name = None; role; admin = false; duties = []; token = secret () } in
  [ make Steers; make Watches ]

let role_word o =
  if o.admin then "admin" else match o.role with Watches -> "watch" | Answers -> "answer" | Steers -> "steer"

let role_name = function Watches -> "watches" | Answers -> "answers" | Steers -> "steers"

(* {1 Questions for some of them} *)

let is_called name o = o.name = Some name || List.mem name o.duties

let addressee operators prompt =
  let named i =
    let name = String.trim (String.sub prompt 0 i) in
    if List.exists (is_called name) operators then Some name else None
  in
  Option.bind (String.index_opt prompt ':') named

let may_answer operators o prompt =
  o.admin || Option.fold (addressee operators prompt) ~none:true ~some:(fun name -> is_called name o)

(* {1 The file} *)

let is_plain c = match c with 'a' .. 'z' | 'A' .. 'Z' | '0' .. '9' | '-' | '_' -> true | _ -> false
let is_name text = text <> "" && String.length text <= 32 && String.for_all is_plain text
let is_token text = String.length text >= 16 && String.length text <= 128 && String.for_all is_plain text

let role = function
  | "watch" -> Ok (Watches, false)
  | "answer" -> Ok (Answers, false)
  | "steer" -> Ok (Steers, false)
  | "admin" -> Ok (Steers, true)
  | other -> Error (Printf.sprintf "'%s' is not a role: watch, answer, steer or admin" (String.escaped other))

let name_rule = "1 to 32 letters, digits, dashes and underscores"

(* [answer,pilot]: the role, and names by which questions reach the operator. *)
let role_and_duties text =
  match String.split_on_char ',' text with
  | [] -> Error "a role is missing"
  | as_ :: duties ->
    let* role, admin = role as_ in
    match List.find_opt (fun duty -> not (is_name duty)) duties with
    | Some duty -> Error (Printf.sprintf "'%s' is not a duty: %s" (String.escaped duty) name_rule)
    | None when role = Watches && duties <> [] -> Error "an operator who watches answers no questions: no duties"
    | None -> Ok (role, admin, duties)

let words line =
  let text = match String.index_opt line '#' with Some i -> String.sub line 0 i | None -> line in
  let blank c = if c = '\t' || c = '\r' then ' ' else c in
  List.filter (( <> ) "") (String.split_on_char ' ' (String.map blank text))

let operator line =
  let make name as_ token =
    let* role, admin, duties = role_and_duties as_ in
    if not (is_name name) then
      Error (Printf.sprintf "'%s' is not a name: %s" (String.escaped name) name_rule)
    else if not (is_token token) then Error "a token has 16 to 128 letters, digits, dashes and underscores"
    else Ok (Some { name = Some name; role; admin; duties; token })
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
