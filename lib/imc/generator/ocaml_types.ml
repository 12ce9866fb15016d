open Dolphin_imc_definition
open Definition
open Code

type set = Enumeration_of of named list | Bits_of of named list

let shared_sets o =
  let definition = Outline.definition o in
  let sets of_ = List.map (fun (name, members) -> (Names.module_ name, of_ members)) in
  sets (fun members -> Enumeration_of members) (enumerations definition)
  @ sets (fun members -> Bits_of members) (bits definition)

let set_module (f : field) { shared; _ } = Names.module_ (Option.value shared ~default:f.name)

let own_sets (m : message) =
  let own (f : field) =
    match f.typ with
    | Number (_, Enumeration ({ shared = None; members } as names)) ->
      Some (set_module f names, Enumeration_of members)
    | Number (_, Bits ({ shared = None; members } as names)) ->
      Some (set_module f names, Bits_of members)
    | Number _ | Text _ | Raw | Inline _ | List _ -> None
  in
  List.filter_map own m.fields

let constant { value; name; _ } = not (value = 0 && String.equal name "NONE")
let parameter o item = if Outline.is_open o item then "'message " else ""

let field_type o (f : field) =
  let contained = function
    | None -> "'message"
    | Some name -> parameter o (Outline.item o name) ^ Names.module_ name ^ ".t"
  in
  match f.typ with
  | Number (_, (Enumeration names | Bits names)) -> set_module f names ^ ".t"
  | Number ((F32 | F64), Quantity _) -> "float"
  | Number (I64, Quantity _) -> "int64"
  | Number ((U8 | U16 | U32 | I8 | I16 | I32), Quantity _) -> "int"
  | Text _ | Raw -> "string"
  | Inline of_ -> contained of_ ^ " option"
  | List of_ -> contained of_ ^ " list"

let commented text comment = line "%s%s" text (if comment = "" then "" else "  " ^ comment)

let record o m ~comment =
  let field (f : field) =
    commented (Printf.sprintf "%s : %s;" (Names.label f.name) (field_type o f)) (comment f)
  in
  let head = Printf.sprintf "type %st = {" (parameter o (Message m)) in
  enclosed head (List.map field m.fields) "}"

let enumeration members ~comment =
  let case (n : named) = commented ("| " ^ Names.constructor n.name) (comment n) in
  under "type t =" (List.map case members @ [ line "| Other of int" ])

(* [constructor o parameter i] is the case of [i] in a type whose parameter is [parameter]. *)
let constructor o parameter item =
  let name = Names.module_ (Outline.name item) in
  match item with
  | Outline.Message { fields = []; _ } -> line "| %s" name
  | Outline.Message _ | Outline.Group _ ->
    line "| %s of %s%s.t" name (if Outline.is_open o item then parameter else "") name

let variant o item members =
  let head = Printf.sprintf "type %st =" (parameter o item) in
  under head (List.map (constructor o "'message ") members)

let all o =
  let items = Outline.all_groups o @ List.map (fun m -> Outline.Message m) (Outline.loose o) in
  under "type t =" (List.map (constructor o "t ") items)
