open Definition

type error = { line : int; column : int; why : string }

let pp_error ppf { line; column; why } =
  if line = 0 then Format.pp_print_string ppf why
  else Format.fprintf ppf "%d:%d: %s" line column why

exception Error of error

let fail (line, column) format = Printf.ksprintf (fun why -> raise (Error { line; column; why })) format

(* {1 Elements: the text between them is prose, and left out} *)

type element = {
  at : Xmlm.pos;  (* The end of its first tag, which is as far as xmlm has looked. *)
  tag : string;
  attributes : (string * string) list;
  parts : element list;
}

(* IMC.xml has four levels, and some 6,000 elements. *)
let most_deep = 100
let most_elements = 100_000

type reader = { input : Xmlm.input; mutable count : int }

let rec element ~depth reader at ((_, tag), attributes) =
  if depth = most_deep then fail at "elements are nested more than %d deep" most_deep;
  reader.count <- reader.count + 1;
  if reader.count > most_elements then fail at "there are more than %d elements" most_elements;
  let attributes = List.map (fun ((_, name), value) -> (name, value)) attributes in
  { at; tag; attributes; parts = elements ~depth:(depth + 1) reader [] }

and elements ~depth reader parts =
  let at = Xmlm.pos reader.input in
  match Xmlm.input reader.input with
  | `El_start tag -> elements ~depth reader (element ~depth reader at tag :: parts)
  | `El_end -> List.rev parts
  | `Data _ | `Dtd _ -> elements ~depth reader parts

let root input =
  ignore (Xmlm.input input);
  let at = Xmlm.pos input in
  match Xmlm.input input with
  | `El_start tag -> element ~depth:0 { input; count = 0 } at tag
  | `El_end | `Data _ | `Dtd _ -> fail at "expected an element"

(* The library recurs once for each attribute. *)
let document text =
  let input = Xmlm.make_input ~strip:true (`String (0, text)) in
  try root input with Stack_overflow -> fail (Xmlm.pos input) "this element has too many attributes"

(* {1 Attributes} *)

let optional e name = List.assoc_opt name e.attributes

let required e name =
  match optional e name with
  | Some value -> value
  | None -> fail e.at "<%s>: the attribute %s is missing" e.tag name

let int e name =
  let text = required e name in
  match Dolphin_numerals.Numeral.whole_or_hexadecimal text with
  | Some n -> n
  | None -> fail e.at "<%s>: the attribute %s is %s, not a number" e.tag name text

let children e tag = List.filter (fun part -> String.equal part.tag tag) e.parts
let grandchildren e tag tag' = List.concat_map (fun part -> children part tag') (children e tag)

(* [title e] is empty if it adds nothing to the short name. *)
let title e =
  let letters text =
    String.concat "" (String.split_on_char ' ' (String.concat " " (String.split_on_char '_' text)))
    |> String.lowercase_ascii
  in
  match (optional e "name", optional e "abbrev") with
  | Some name, Some abbrev when String.equal (letters name) (letters abbrev) -> ""
  | Some name, _ -> name
  | None, _ -> ""

(* {1 Definitions} *)

let value e = { value = int e "id"; name = required e "abbrev"; title = title e }
let set e = (required e "abbrev", List.map value (children e "value"))

let scalar = function
  | "uint8_t" -> Some U8
  | "uint16_t" -> Some U16
  | "uint32_t" -> Some U32
  | "int8_t" -> Some I8
  | "int16_t" -> Some I16
  | "int32_t" -> Some I32
  | "int64_t" -> Some I64
  | "fp32_t" -> Some F32
  | "fp64_t" -> Some F64
  | _ -> None

let names sets e reference =
  match optional e reference with
  | None -> { shared = None; members = List.map value (children e "value") }
  | Some name -> (
      match List.assoc_opt name sets with
      | Some members -> { shared = Some name; members }
      | None -> fail e.at "<%s>: nothing is named %s" e.tag name)

let field ~enumerations ~bits e =
  let unit = optional e "unit" in
  let typ =
    match required e "type" with
    | "plaintext" -> Text { tuples = unit = Some "TupleList" }
    | "rawdata" -> Raw
    | "message" -> Inline (optional e "message-type")
    | "message-list" -> List (optional e "message-type")
    | name -> (
        match (scalar name, unit) with
        | None, _ -> fail e.at "<field>: %s is not a type of IMC" name
        | Some scalar, Some "Enumerated" ->
          Number (scalar, Enumeration (names enumerations e "enum-def"))
        | Some scalar, Some "Bitfield" -> Number (scalar, Bits (names bits e "bitfield-def"))
        | Some scalar, _ -> Number (scalar, Quantity (List.map value (children e "value"))))
  in
  let unit = match typ with Number (_, Quantity _) -> unit | _ -> None in
  { name = required e "abbrev"; typ; unit; title = title e }

let message ~enumerations ~bits e =
  let fields = List.map (field ~enumerations ~bits) (children e "field") in
  { id = int e "id"; name = required e "abbrev"; title = title e; fields }

let group e =
  let member e = required e "abbrev" in
  { name = required e "abbrev"; members = List.map member (children e "message-type") }

let definition root =
  if not (String.equal root.tag "messages") then
    fail root.at "expected <messages>, the root of an IMC.xml, and found <%s>" root.tag;
  let enumerations = List.map set (grandchildren root "enumerations" "def") in
  let bits = List.map set (grandchildren root "bitfields" "def") in
  let groups = List.map group (grandchildren root "message-groups" "message-group") in
  let messages = List.map (message ~enumerations ~bits) (children root "message") in
  match make ~enumerations ~bits ~groups messages with
  | Ok definition -> definition
  | Error { about; why } ->
    (* If it is there twice, the second is at fault. *)
    let named e = optional e "abbrev" = Some about in
    let all = children root "message" @ grandchildren root "message-groups" "message-group" in
    let at = match List.rev (List.filter named all) with e :: _ -> e.at | [] -> (0, 0) in
    fail at "%s" why

let parse text =
  match definition (document text) with
  | definition -> Ok definition
  | exception Error error -> Error error
  | exception Xmlm.Error ((line, column), fault) ->
    Error { line; column; why = Xmlm.error_message fault }

let contents path =
  let channel = open_in_bin path in
  Fun.protect
    ~finally:(fun () -> close_in_noerr channel)
    (fun () -> really_input_string channel (in_channel_length channel))

let read path =
  match contents path with
  | text -> parse text
  | exception Sys_error why -> Error { line = 0; column = 0; why }
  | exception End_of_file -> Error { line = 0; column = 0; why = path ^ ": cannot be read whole" }
