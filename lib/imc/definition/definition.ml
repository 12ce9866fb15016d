type scalar = U8 | U16 | U32 | I8 | I16 | I32 | I64 | F32 | F64
let scalar_name = function
  | U8 -> "u8"
  | U16 -> "u16"
  | U32 -> "u32"
  | I8 -> "i8"
  | I16 -> "i16"
  | I32 -> "i32"
  | I64 -> "i64"
  | F32 -> "f32"
  | F64 -> "f64"

type named = { value : int; name : string; title : string }
type names = { shared : string option; members : named list }
type meaning = Quantity of named list | Enumeration of names | Bits of names

type typ =
  | Number of scalar * meaning
  | Text of { tuples : bool }
  | Raw
  | Inline of string option
  | List of string option

type field = { name : string; typ : typ; unit : string option; title : string }
type message = { id : int; name : string; title : string; fields : field list }
type group = { name : string; members : string list }

module By_id = Map.Make (Int)
module By_name = Map.Make (String)

type t = {
  enumerations : (string * named list) list;
  bits : (string * named list) list;
  groups : group list;
  messages : message list;
  by_id : message By_id.t;
  by_name : message By_name.t;
  group_of_name : group By_name.t;
}

let enumerations d = d.enumerations
let bits d = d.bits
let groups d = d.groups
let messages d = d.messages
let find d id = By_id.find_opt id d.by_id
let find_name d name = By_name.find_opt name d.by_name

let admits d name (m : message) =
  String.equal name m.name
  ||
  match By_name.find_opt name d.group_of_name with
  | Some g -> List.mem m.name g.members
  | None -> false

(* {1 Making} *)

type fault = { about : string; why : string }

exception Invalid of fault

let invalid about format = Printf.ksprintf (fun why -> raise (Invalid { about; why })) format

let index_messages messages =
  let add (by_id, by_name) (m : message) =
    if m.id < 0 || m.id >= 0xFFFF then invalid m.name "message %s: the id %d is not in 0 .. 65534" m.name m.id;
    if By_id.mem m.id by_id then invalid m.name "message %s: the id %d is taken" m.name m.id;
    if By_name.mem m.name by_name then invalid m.name "message %s is defined twice" m.name;
    (By_id.add m.id m by_id, By_name.add m.name m by_name)
  in
  List.fold_left add (By_id.empty, By_name.empty) messages

let check d =
  let defined name = By_name.mem name d.by_name || By_name.mem name d.group_of_name in
  let check_group g =
    let check_member name =
      if not (By_name.mem name d.by_name) then invalid g.name "group %s: no message is named %s" g.name name
    in
    List.iter check_member g.members
  in
  let check_field (m : message) (f : field) =
    match f.typ with
    | Inline (Some name) | List (Some name) ->
      if not (defined name) then invalid m.name "%s.%s: no message or group is named %s" m.name f.name name
    | Number (_, Enumeration { shared = Some name; _ }) ->
      if not (List.mem_assoc name d.enumerations) then
        invalid m.name "%s.%s: no enumeration is named %s" m.name f.name name
    | Number (_, Bits { shared = Some name; _ }) ->
      if not (List.mem_assoc name d.bits) then
        invalid m.name "%s.%s: no set of bits is named %s" m.name f.name name
    | Number _ | Text _ | Raw | Inline None | List None -> ()
  in
  List.iter check_group d.groups;
  List.iter (fun (m : message) -> List.iter (check_field m) m.fields) d.messages

let make ~enumerations ~bits ~groups messages =
  try
    let by_id, by_name = index_messages messages in
    let add_group index (g : group) =
      if By_name.mem g.name by_name then invalid g.name "%s is both a message and a group" g.name;
      By_name.add g.name g index
    in
    let group_of_name = List.fold_left add_group By_name.empty groups in
    let d = { enumerations; bits; groups; messages; by_id; by_name; group_of_name } in
    check d;
    Ok d
  with Invalid fault -> Error fault

(* {1 Comparing} *)

(* The part of a field that is seen on the wire. *)
let layout (f : field) =
  match f.typ with
  | Number (scalar, _) -> scalar_name scalar
  | Text _ -> "text"
  | Raw -> "raw"
  | Inline _ -> "inline"
  | List _ -> "list"

let difference d ~than name =
  let spelt (f : field) = Printf.sprintf "%s %s" f.name (layout f) in
  let rec fields n (here : field list) (there : field list) =
    match here, there with
    | [], [] -> None
    | f :: here, g :: there when layout f = layout g -> fields (n + 1) here there
    | f :: _, g :: _ -> Some (Printf.sprintf "field %d of message %s is %s, not %s" n name (spelt f) (spelt g))
    | f :: _, [] -> Some (Printf.sprintf "message %s has a field %d, %s" name n (spelt f))
    | [], g :: _ -> Some (Printf.sprintf "message %s has no field %d, %s" name n (spelt g))
  in
  match find_name d name, find_name than name with
  | _, None -> None
  | None, Some _ -> Some (Printf.sprintf "no message is named %s" name)
  | Some m, Some m' when m.id <> m'.id -> Some (Printf.sprintf "message %s has the id %d, not %d" name m.id m'.id)
  | Some m, Some m' -> fields 1 m.fields m'.fields

(* {1 Printing} *)

let pp_title ppf title = if title <> "" then Format.fprintf ppf " -- %s" title

let pp_named ~indent ~hex ppf { value; name; title } =
  let value = Printf.sprintf (if hex then "0x%X" else "%d") value in
  Format.fprintf ppf "%s%s %s%a@\n" indent value name pp_title title

let pp_field ppf { name; typ; unit; title } =
  let line typ meaning =
    let meaning = if meaning = "" then "" else " " ^ meaning in
    Format.fprintf ppf "  %s %s%s%a@\n" name typ meaning pp_title title
  in
  let own ~hex names = List.iter (pp_named ~indent:"    " ~hex ppf) names in
  let number scalar keyword { shared; members } ~hex =
    match shared with
    | Some set -> line (scalar_name scalar) (keyword ^ " " ^ set)
    | None ->
      line (scalar_name scalar) keyword;
      own ~hex members
  in
  match typ with
  | Number (scalar, Quantity exceptions) ->
    line (scalar_name scalar) (Option.value unit ~default:"");
    own ~hex:false exceptions
  | Number (scalar, Enumeration names) -> number scalar "enum" names ~hex:false
  | Number (scalar, Bits names) -> number scalar "bits" names ~hex:true
  | Text { tuples } -> line "text" (if tuples then "tuples" else "")
  | Raw -> line "raw" ""
  | Inline of_ -> line "inline" (Option.value of_ ~default:"any")
  | List of_ -> line "list" (Option.value of_ ~default:"any")

let pp ppf d =
  let set keyword ~hex (name, members) =
    Format.fprintf ppf "%s %s@\n" keyword name;
    List.iter (pp_named ~indent:"  " ~hex ppf) members
  in
  let group (g : group) =
    Format.fprintf ppf "group %s@\n" g.name;
    List.iter (Format.fprintf ppf "  %s@\n") g.members
  in
  let message (m : message) =
    Format.fprintf ppf "message %d %s%a@\n" m.id m.name pp_title m.title;
    List.iter (pp_field ppf) m.fields
  in
  List.iter (set "enum" ~hex:false) d.enumerations;
  List.iter (set "bits" ~hex:true) d.bits;
  List.iter group d.groups;
  List.iter message d.messages
