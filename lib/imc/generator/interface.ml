open Dolphin_imc_definition
open Definition
open Code

(* {1 Comments} *)

(* Prose within a documentation comment: the characters that ocamldoc would read are escaped. *)
let prose text =
  let escape c = match c with '{' | '}' | '[' | ']' | '@' -> Printf.sprintf "\\%c" c | c -> String.make 1 c in
  String.concat "" (List.map escape (List.of_seq (String.to_seq text)))

let type_name = function
  | Number (I8, _) -> "i8"
  | Number (U8, _) -> "u8"
  | Number (I16, _) -> "i16"
  | Number (U16, _) -> "u16"
  | Number (I32, _) -> "i32"
  | Number (U32, _) -> "u32"
  | Number (F32, _) -> "f32"
  | Number ((F64 | I64), _) | Text _ | Raw | Inline _ | List _ -> ""

(* The title, the unit and whatever else there is to say, then the type on the wire: "Timeout, s (u16)". *)
let field_comment (f : field) =
  let more =
    match f.typ with
    | Number (_, Quantity named) ->
      List.map (fun (n : named) -> Printf.sprintf "%d is %s" n.value (prose n.name)) named
    | Text { tuples = true } -> [ "tuples" ]
    | Raw -> [ "any bytes" ]
    | Number _ | Text _ | Inline _ | List _ -> []
  in
  let parts = prose f.title :: Option.fold ~none:"" ~some:prose f.unit :: more in
  match (String.concat ", " (List.filter (fun part -> part <> "") parts), type_name f.typ) with
  | "", "" -> ""
  | "", typ -> Printf.sprintf "(** %s. *)" typ
  | text, "" -> Printf.sprintf "(** %s. *)" text
  | text, typ -> Printf.sprintf "(** %s (%s). *)" text typ

let message_comment (m : message) =
  line "(** %sMessage %d. *)" (if m.title = "" then "" else prose m.title ^ ". ") m.id

(* {1 Sets of values} *)

let enumeration name members =
  let comment (n : named) =
    Printf.sprintf "(** %d%s. *)" n.value (if n.title = "" then "" else ": " ^ prose n.title)
  in
  [
    line "module %s : sig" name;
    Nest
      (Shape.enumeration members ~comment
       @ [ line ""; line "include Enumeration.S with type t := t" ]);
    line "end";
  ]

let bits name members =
  let constant (n : named) =
    [
      line "";
      line "val %s : t" (Names.value n.name);
      line "(** [0x%X]%s. *)" n.value (if n.title = "" then "" else ": " ^ prose n.title);
    ]
  in
  [
    line "module %s : sig" name;
    Nest (line "include Bits.S" :: List.concat_map constant (List.filter Shape.constant members));
    line "end";
  ]

let set (name, set) =
  (match set with
   | Shape.Enumeration_of members -> enumeration name members
   | Shape.Bits_of members -> bits name members)
  @ [ line "" ]

(* {1 Messages and groups} *)

let message o (m : message) =
  let name = Names.module_ m.name in
  let id = line "val id : int  (** [%d]. *)" m.id in
  let body =
    match m.fields with
    | [] -> [ id ]
    | _ ->
      List.concat_map set (Shape.own_sets m)
      @ Shape.record o m ~comment:field_comment
      @ [
        line "";
        id;
        line "";
        line "val default : %st" (Shape.parameter o (Message m));
        line "(** Every number 0, every text and list empty, no message within. *)";
      ]
  in
  [ message_comment m; line "module %s : sig" name; Nest body; line "end"; line "" ]

let group o (g : group) members =
  let case m = line "| %s" (Shape.constructor o (Message m)) in
  [
    line "module %s : sig" (Names.module_ g.name);
    Nest [ line "type %st =" (Shape.parameter o (Group (g, members))); Nest (List.map case members) ];
    line "end";
    line "";
  ]

let item o = function
  | Outline.Message m -> message o m
  | Outline.Group (g, members) -> group o g members

let all o =
  let definition = Outline.definition o in
  let groups = List.map (fun (g : group) -> Outline.item o g.name) (groups definition) in
  let items = groups @ List.map (fun m -> Outline.Message m) (Outline.loose o) in
  [
    line "type t =";
    Nest (List.map (fun item -> line "| %s" (Shape.constructor o item)) items);
    line "";
    line "val id : t -> int";
    line "";
    line "val name : t -> string";
    line "(** The name in IMC's definition: [\"PlanControl\"]. *)";
    line "";
    line "val is_known : int -> bool";
    line "(** [is_known id]: some message here has the number [id]. *)";
    line "";
    line "val equal : t -> t -> bool";
    line "(** Equality of content; a number that is not a number equals itself. *)";
    line "";
    line "val to_json : t -> Yojson.Safe.t";
    line "(** An object: [\"abbrev\"], the name, then the fields under the names of IMC. Enumerations stand by";
    line "    name, bits as lists of names, raw bytes in hexadecimal; units are those of the fields. *)";
    line "";
    line "val pp : Format.formatter -> t -> unit";
    line "(** {!to_json}, printed. *)";
    line "";
    line "(** {1:codec Codec} For {!Packet}. *)";
    line "";
    line "val read : Reader.t -> int -> t";
    line "(** [read r id] is the message [id], its fields read from [r].";
    line "    @raise Reader.Fault if there is no such message, or the bytes are not one. *)";
    line "";
    line "val write : Writer.t -> t -> unit";
    line "(** [write w m] writes the fields of [m].";
    line "    @raise Writer.Fault if [m] cannot be written. *)";
  ]

let code o =
  [
    line "(** The messages of IMC that Dolphin reads and writes.";
    line "";
    line "    Generated from [messages.def], which names the source. Every message is a module: its record [t],";
    line "    its number [id], and [default] to build from: [{ Goto.default with lat; lon }]. A comment on a";
    line "    field gives its unit, and in parentheses its type on the wire if OCaml's is wider.";
    line "";
    line "    Where a message can contain any other, its type has that as a parameter, ['message]; in {!t},";
    line "    ['message] is {!t}. *)";
    line "";
    line "(** {1:values Values that several messages share} *)";
    line "";
  ]
  @ List.concat_map set (Shape.shared_sets o)
  @ [ line "(** {1:messages Messages} *)"; line "" ]
  @ List.concat_map (item o) (Outline.items o)
  @ [ line "(** {1:any Any message} *)"; line "" ]
  @ all o
