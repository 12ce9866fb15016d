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

let with_comment text comment = line "%s%s" text (if comment = "" then "" else "  " ^ comment)

let record o m ~comment =
  let field (f : field) =
    with_comment (Printf.sprintf "%s : %s;" (Names.label f.name) (field_type o f)) (comment f)
  in
  [ line "type %st = {" (parameter o (Message m)); Nest (List.map field m.fields); line "}" ]

let enumeration members ~comment =
  let case (n : named) = with_comment ("| " ^ Names.constructor n.name) (comment n) in
  [
    line "type t =";
    Nest (List.map case members @ [ line "| Other of int" ]);
  ]

let constructor o item =
  let name = Names.module_ (Outline.name item) in
  match item with
  | Message { fields = []; _ } -> name
  | Message _ | Group _ ->
    let parameter = if Outline.is_open o item then "t " else "" in
    Printf.sprintf "%s of %s%s.t" name parameter name
