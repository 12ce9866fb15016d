type t = Element of string * (string * string) list * t list | Text of string | Raw of string

let element name attributes children = Element (name, attributes, children)
let raw markup = Raw markup
let text_only text = Text text

let number x =
  let text = Printf.sprintf "%.1f" x in
  let n = String.length text in
  let text = if text.[n - 1] = '0' then String.sub text 0 (n - 2) else text in
  if text = "-0" then "0" else text

let named name attributes = match name with None -> attributes | Some name -> ("class", name) :: attributes
let tips = function None -> [] | Some tip -> [ Element ("title", [], [ Text tip ]) ]
let group ?name children = Element ("g", named name [], children)

let chart ~left ~right ~top ~bottom children =
  let edge name x = ("data-" ^ name, number x) in
  let edges = [ edge "left" left; edge "right" right; edge "top" top; edge "bottom" bottom ] in
  Element ("g", ("class", "chart") :: edges, children)

let rect ?name ?(round = 0.) ?tip ~x ~y ~width ~height () =
  let rounded = if round > 0. then [ ("rx", number round) ] else [] in
  let place =
    [ ("x", number x); ("y", number y); ("width", number (Float.max 0. width));
      ("height", number (Float.max 0. height)) ]
  in
  Element ("rect", named name (place @ rounded), tips tip)

let line ?name (x, y) (x', y') =
  Element ("line", named name [ ("x1", number x); ("y1", number y); ("x2", number x'); ("y2", number y') ], [])

let polyline ?name ?tip points =
  let point (x, y) = number x ^ "," ^ number y in
  Element ("polyline", named name [ ("points", String.concat " " (List.map point points)) ], tips tip)

let circle ?name ?tip (x, y) radius =
  Element ("circle", named name [ ("cx", number x); ("cy", number y); ("r", number radius) ], tips tip)

let path ?name ?tip d = Element ("path", named name [ ("d", d) ], tips tip)

type anchor = Start | Middle | End

let text ?name ?(anchor = Start) ?tip (x, y) content =
  let anchored =
    match anchor with
    | Start -> []
    | Middle -> [ ("text-anchor", "middle") ]
    | End -> [ ("text-anchor", "end") ]
  in
  Element ("text", named name ([ ("x", number x); ("y", number y) ] @ anchored), tips tip @ [ Text content ])

(* {1 Widths} *)

let default_size = 11.
let share_of_size = 0.56

let characters text =
  let is_continuation c = Char.code c land 0xC0 = 0x80 in
  String.fold_left (fun n c -> if is_continuation c then n else n + 1) 0 text

let width ?(size = default_size) text = float_of_int (characters text) *. size *. share_of_size

(* The first [n] characters. *)
let first n text =
  let rec stop i left =
    if i >= String.length text then i
    else if Char.code text.[i] land 0xC0 = 0x80 then stop (i + 1) left
    else if left = 0 then i
    else stop (i + 1) (left - 1)
  in
  String.sub text 0 (stop 0 n)

let fit ?(size = default_size) available text =
  if width ~size text <= available then text
  else
    let n = int_of_float (available /. (size *. share_of_size)) - 1 in
    if n < 1 then "" else first n text ^ "…"

(* {1 Text} *)

let escape buffer text =
  let text = Dolphin_utf8.Utf8.line (String.map (function '\000' .. '\031' -> ' ' | c -> c) text) in
  let character = function
    | '&' -> Buffer.add_string buffer "&amp;"
    | '<' -> Buffer.add_string buffer "&lt;"
    | '>' -> Buffer.add_string buffer "&gt;"
    | '"' -> Buffer.add_string buffer "&quot;"
    | c -> Buffer.add_char buffer c
  in
  String.iter character text

let rec write buffer = function
  | Raw markup -> Buffer.add_string buffer markup
  | Text text -> escape buffer text
  | Element (name, attributes, children) ->
    let attribute (name, x) =
      Printf.bprintf buffer " %s=\"" name;
      escape buffer x;
      Buffer.add_char buffer '"'
    in
    Printf.bprintf buffer "<%s" name;
    List.iter attribute attributes;
    if children = [] then Buffer.add_string buffer "/>"
    else begin
      Buffer.add_char buffer '>';
      List.iter (write buffer) children;
      Printf.bprintf buffer "</%s>" name
    end;
    if name <> "title" && name <> "text" then Buffer.add_char buffer '\n'

let to_string t =
  let buffer = Buffer.create 65536 in
  write buffer t;
  Buffer.contents buffer
