open Definition

type error = { line : int; why : string }

let pp_error ppf { line; why } =
  if line = 0 then Format.pp_print_string ppf why else Format.fprintf ppf "line %d: %s" line why

exception Error of error

let fail line format = Printf.ksprintf (fun why -> raise (Error { line; why })) format

(* {1 Lines, nested by indentation} *)

type line = { number : int; indent : int; words : string list; title : string }
type tree = { at : int; words : string list; title : string; parts : tree list }

let split_title text =
  let separator = " -- " in
  let rec find i =
    if i + 4 > String.length text then (text, "")
    else if String.equal (String.sub text i 4) separator then
      (String.sub text 0 i, String.trim (String.sub text (i + 4) (String.length text - i - 4)))
    else find (i + 1)
  in
  find 0

let indentation text =
  let rec count i = if i < String.length text && text.[i] = ' ' then count (i + 1) else i in
  count 0

let line_of_text number text =
  let text = match String.index_opt text '#' with Some i -> String.sub text 0 i | None -> text in
  let spelling, title = split_title text in
  let words = List.filter (fun word -> word <> "") (String.split_on_char ' ' (String.trim spelling)) in
  if words = [] then None else Some { number = number + 1; indent = indentation text; words; title }

(* [forest indent lines] is the trees whose heads are indented by [indent], and the lines after them. *)
let rec forest indent = function
  | { number; indent = i; words; title } :: rest when i = indent ->
    let parts, rest = forest (indent + 2) rest in
    let siblings, rest = forest indent rest in
    ({ at = number; words; title; parts } :: siblings, rest)
  | { number; indent = i; _ } :: _ when i > indent ->
    fail number "indented by %d blanks instead of at most %d" i indent
  | rest -> ([], rest)

(* {1 Items} *)

let int { at; _ } word =
  match Dolphin_numerals.Numeral.whole_or_hexadecimal word with Some n -> n | None -> fail at "%s is not a number" word

let leaf tree = if tree.parts <> [] then fail tree.at "nothing can be indented under this line"

let named tree =
  leaf tree;
  match tree.words with
  | [ value; name ] -> { value = int tree value; name; title = tree.title }
  | _ -> fail tree.at "expected a value and its name"

let member tree =
  leaf tree;
  match tree.words with [ name ] -> name | _ -> fail tree.at "expected the name of one message"

let scalar = function
  | "u8" -> Some U8
  | "u16" -> Some U16
  | "u32" -> Some U32
  | "i8" -> Some I8
  | "i16" -> Some I16
  | "i32" -> Some I32
  | "i64" -> Some I64
  | "f32" -> Some F32
  | "f64" -> Some F64
  | _ -> None

let restriction = function "any" -> None | name -> Some name

(* [names sets tree set] is the names that a field refers to: [set], or its own, below it. *)
let names sets tree = function
  | None -> { shared = None; members = List.map named tree.parts }
  | Some set -> (
      leaf tree;
      match List.assoc_opt set sets with
      | Some members -> { shared = Some set; members }
      | None -> fail tree.at "no set of values is named %s" set)

let number ~enumerations ~bits tree scalar = function
  | "enum" :: set when List.length set < 2 ->
    (Number (scalar, Enumeration (names enumerations tree (List.nth_opt set 0))), None)
  | "bits" :: set when List.length set < 2 ->
    (Number (scalar, Bits (names bits tree (List.nth_opt set 0))), None)
  | [ unit ] -> (Number (scalar, Quantity (List.map named tree.parts)), Some unit)
  | [] -> (Number (scalar, Quantity (List.map named tree.parts)), None)
  | _ -> fail tree.at "expected a unit, or enum [NAME], or bits [NAME]"

let field ~enumerations ~bits tree =
  let field name (typ, unit) = { name; typ; unit; title = tree.title } in
  let plain name typ =
    leaf tree;
    field name (typ, None)
  in
  match tree.words with
  | [ name; "text" ] -> plain name (Text { tuples = false })
  | [ name; "text"; "tuples" ] -> plain name (Text { tuples = true })
  | [ name; "raw" ] -> plain name Raw
  | [ name; "inline"; of_ ] -> plain name (Inline (restriction of_))
  | [ name; "list"; of_ ] -> plain name (List (restriction of_))
  | name :: typ :: meaning -> (
      match scalar typ with
      | Some scalar -> field name (number ~enumerations ~bits tree scalar meaning)
      | None -> fail tree.at "%s is not a type that can stand here" typ)
  | _ -> fail tree.at "expected a field: NAME TYPE [MEANING]"

let definition trees =
  let sets keyword =
    let set tree =
      match tree.words with
      | [ word; name ] when String.equal word keyword -> Some (name, List.map named tree.parts)
      | _ -> None
    in
    List.filter_map set trees
  in
  let enumerations = sets "enum" and bits = sets "bits" in
  let item (groups, messages) tree =
    match tree.words with
    | [ ("enum" | "bits"); _ ] -> (groups, messages)
    | [ "group"; name ] -> ({ name; members = List.map member tree.parts } :: groups, messages)
    | [ "message"; id; name ] ->
      let fields = List.map (field ~enumerations ~bits) tree.parts in
      (groups, { id = int tree id; name; title = tree.title; fields } :: messages)
    | _ -> fail tree.at "expected enum NAME, bits NAME, group NAME, or message ID NAME"
  in
  let groups, messages = List.fold_left item ([], []) trees in
  make ~enumerations ~bits ~groups:(List.rev groups) (List.rev messages)

let parse text =
  try
    let lines = List.filter_map Fun.id (List.mapi line_of_text (String.split_on_char '\n' text)) in
    let trees, _ = forest 0 lines in
    Result.map_error (fun ({ why; about = _ } : fault) -> { line = 0; why }) (definition trees)
  with Error error -> Error error
