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

let read text =
  (* Prefixes without a declaration are common, and mean nothing here. *)
  let input = Xmlm.make_input ~strip:true ~ns:(fun prefix -> Some prefix) (`String (0, text)) in
  try tree input
  with Xmlm.Error (position, error) ->
    Drawn.wrong (place_of position) "this is no XML: %s" (Xmlm.error_message error)

let child tag x = List.find_opt (fun y -> y.tag = tag) x.inside
let children tag x = List.filter (fun y -> y.tag = tag) x.inside
let text_of tag x = match child tag x with Some y -> y.text | None -> ""

let number x text =
  match float_of_string_opt text with
  | Some number when Float.is_finite number -> number
  | Some _ | None -> Drawn.wrong x.place "'%s' is no number" (if String.length text > 40 then "..." else text)
