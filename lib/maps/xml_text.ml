type t = { tag : string; attributes : (string * string) list; inside : t list; text : string; place : string }

let most_deep = 100

(* An element whose end is not read yet; parts are latest first. *)
type opened = { it : t; mutable parts : t list; mutable texts : string list }

let closed o =
  { o.it with inside = List.rev o.parts; text = String.trim (String.concat "" (List.rev o.texts)) }

let local (_, name) =
  match String.rindex_opt name ':' with
  | Some i -> String.sub name (i + 1) (String.length name - i - 1)
  | None -> name

let place_of (line, column) = Printf.sprintf "line %d, column %d" line column

let tree input =
  let rec go stack depth =
    (* The input is one tag ahead. *)
    let line = Printf.sprintf "line %d" (fst (Xmlm.pos input)) in
    match Xmlm.input input, stack with
    | `Dtd _, _ -> go stack depth
    | `El_start (name, attributes), _ ->
      if depth = most_deep then Drawn.wrong line "elements are nested more than %d deep" most_deep;
      let attributes = List.map (fun (name, value) -> (local name, value)) attributes in
      let it = { tag = local name; attributes; inside = []; text = ""; place = line } in
      go ({ it; parts = []; texts = [] } :: stack) (depth + 1)
    | `Data text, top :: _ ->
      top.texts <- text :: top.texts;
      go stack depth
    | `El_end, [ root ] -> closed root
    | `El_end, top :: (around :: _ as stack) ->
      around.parts <- closed top :: around.parts;
      go stack (depth - 1)
    | (`Data _ | `El_end), [] -> go stack depth
  in
  go [] 0

(* Encodings that Xmlm does not know. *)
let other_encodings =
  [ ("windows-1252", Utf8_text.of_windows_1252); ("cp1252", Utf8_text.of_windows_1252);
    ("iso-8859-15", Utf8_text.of_iso_8859_15); ("iso8859-15", Utf8_text.of_iso_8859_15);
    ("latin-9", Utf8_text.of_iso_8859_15) ]

(* That of the declaration, which is in ASCII. *)
let other_encoding text =
  let head = String.lowercase_ascii (String.sub text 0 (Int.min 200 (String.length text))) in
  let declaration = match String.index_opt head '>' with Some i -> String.sub head 0 i | None -> "" in
  let quoted = String.concat "\"" (String.split_on_char '\'' declaration) in
  if not (String.starts_with ~prefix:"<?xml" declaration) then None
  else List.find_map (fun word -> List.assoc_opt word other_encodings) (String.split_on_char '"' quoted)

let read text =
  (* Prefixes without a declaration are common, and mean nothing here. *)
  let text, enc =
    match other_encoding text with Some in_utf_8 -> (in_utf_8 text, Some `UTF_8) | None -> (text, None) in
  let input = Xmlm.make_input ~enc ~strip:true ~ns:(fun prefix -> Some prefix) (`String (0, text)) in
  try tree input
  with Xmlm.Error (position, error) ->
    Drawn.wrong (place_of position) "this is not XML: %s" (Xmlm.error_message error)

let child tag x = List.find_opt (fun y -> y.tag = tag) x.inside
let children tag x = List.filter (fun y -> y.tag = tag) x.inside
let text_of tag x = match child tag x with Some y -> y.text | None -> ""

let number x text =
  match Dolphin_numerals.Numeral.number (String.trim text) with
  | Some number -> number
  | None -> Drawn.wrong x.place "'%s' is not a number" (if String.length text > 40 then "..." else text)
