open Dolphin_imc_definition
open Definition
open Code

<<<<<<< HEAD
=======
let spf = Printf.sprintf

>>>>>>> wt-imc
(* {1 Comments} *)

(* Prose within a documentation comment: the characters that ocamldoc would read are escaped. *)
let prose text =
<<<<<<< HEAD
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
=======
  let escape = function
    | ('{' | '}' | '[' | ']' | '@') as c -> spf "\\%c" c
    | c -> String.make 1 c
  in
  String.concat "" (List.map escape (List.of_seq (String.to_seq text)))

(* The type on the wire, where the OCaml type does not tell. *)
let wire_type = function
  | Number (((I8 | U8 | I16 | U16 | I32 | U32 | F32) as scalar), _) -> scalar_name scalar
  | Number ((F64 | I64), _) | Text _ | Raw | Inline _ | List _ -> ""

(* The title, the unit and whatever else there is to say, then the type: "Timeout, s (u16)". *)
>>>>>>> wt-imc
let field_comment (f : field) =
  let more =
    match f.typ with
    | Number (_, Quantity named) ->
<<<<<<< HEAD
      List.map (fun (n : named) -> Printf.sprintf "%d is %s" n.value (prose n.name)) named
=======
      List.map (fun (n : named) -> spf "%d is %s" n.value (prose n.name)) named
>>>>>>> wt-imc
    | Text { tuples = true } -> [ "tuples" ]
    | Raw -> [ "any bytes" ]
    | Number _ | Text _ | Inline _ | List _ -> []
  in
<<<<<<< HEAD
  let parts = prose f.title :: Option.fold ~none:"" ~some:prose f.unit :: more in
  match (String.concat ", " (List.filter (fun part -> part <> "") parts), type_name f.typ) with
  | "", "" -> ""
  | "", typ -> Printf.sprintf "(** %s. *)" typ
  | text, "" -> Printf.sprintf "(** %s. *)" text
  | text, typ -> Printf.sprintf "(** %s (%s). *)" text typ

let message_comment (m : message) =
  line "(** %sMessage %d. *)" (if m.title = "" then "" else prose m.title ^ ". ") m.id
=======
  let parts = prose f.title :: prose (Option.value f.unit ~default:"") :: more in
  match (String.concat ", " (List.filter (fun part -> part <> "") parts), wire_type f.typ) with
  | "", "" -> ""
  | "", typ -> spf "(** %s. *)" typ
  | text, "" -> spf "(** %s. *)" text
  | text, typ -> spf "(** %s (%s). *)" text typ

let colon title = if title = "" then "" else ": " ^ prose title
>>>>>>> wt-imc

(* {1 Sets of values} *)

let enumeration name members =
<<<<<<< HEAD
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
=======
  let comment (n : named) = spf "(** %d%s. *)" n.value (colon n.title) in
  let body =
    paragraphs
      [ Shape.enumeration members ~comment; [ line "include Enumeration.S with type t := t" ] ]
  in
  enclosed (spf "module %s : sig" name) body "end"

let bits name members =
  let constant (n : named) =
    [ line "val %s : t" (Names.value n.name); line "(** [0x%X]%s. *)" n.value (colon n.title) ]
  in
  let constants = List.map constant (List.filter Shape.constant members) in
  enclosed (spf "module %s : sig" name) (paragraphs ([ line "include Bits.S" ] :: constants)) "end"

let set = function
  | name, Shape.Enumeration_of members -> enumeration name members
  | name, Shape.Bits_of members -> bits name members
>>>>>>> wt-imc

(* {1 Messages and groups} *)

let message o (m : message) =
<<<<<<< HEAD
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
=======
  let id = [ line "val id : int  (** [%d]. *)" m.id ] in
  let default =
    [
      line "val default : %st" (Shape.parameter o (Message m));
      line "(** Every number 0, every text and list empty, no message within. *)";
    ]
  in
  let body =
    match m.fields with
    | [] -> id
    | _ ->
      let sets = List.map set (Shape.own_sets m) in
      paragraphs (sets @ [ Shape.record o m ~comment:field_comment; id; default ])
  in
  let title = if m.title = "" then "" else prose m.title ^ ". " in
  line "(** %sMessage %d. *)" title m.id
  :: enclosed (spf "module %s : sig" (Names.module_ m.name)) body "end"

let group o (g : group) members =
  let item = Outline.Group (g, members) in
  let body = Shape.variant o item (List.map (fun m -> Outline.Message m) members) in
  enclosed (spf "module %s : sig" (Names.module_ g.name)) body "end"
>>>>>>> wt-imc

let item o = function
  | Outline.Message m -> message o m
  | Outline.Group (g, members) -> group o g members

<<<<<<< HEAD
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
=======
(* {1 The whole} *)

let head =
  {|(** The messages of IMC that Dolphin reads and writes.

    Generated from [messages.def], which names the source. Every message is a module: its record
    [t], its number [id], and [default] to build from: [{ Goto.default with lat; lon }]. A comment
    on a field gives its unit, and in parentheses its type on the wire if OCaml's is wider.

    Where a message can contain any other, its type has that as a parameter, ['message]; in {!t},
    ['message] is {!t}. *)|}

let functions =
  {|val id : t -> int

val name : t -> string
(** The name in IMC's definition: ["PlanControl"]. *)

val is_known : int -> bool
(** [is_known id]: some message here has the number [id]. *)

val equal : t -> t -> bool
(** Equality of content; a number that is not a number equals itself. *)

val to_json : t -> Yojson.Safe.t
(** An object: ["abbrev"], the name, then the fields under the names of IMC. Enumerations stand by
    name, bits as lists of names, raw bytes in hexadecimal; units are those of the fields. *)

val pp : Format.formatter -> t -> unit
(** {!to_json}, printed. *)

(** {1:codec Codec} For {!Packet}. *)

val read : Reader.t -> int -> t
(** [read r id] is the message [id], its fields read from [r].
    @raise Reader.Fault if there is no such message, or the bytes are not one. *)

val write : Writer.t -> t -> unit
(** [write w m] writes the fields of [m].
    @raise Writer.Fault if [m] cannot be written. *)|}

let text lines = List.map (line "%s") (String.split_on_char '\n' lines)
let title label words = [ line "(** {1:%s %s} *)" label words ]

let code o =
  paragraphs
    ([ text head; title "values" "Values that several messages share" ]
     @ List.map set (Shape.shared_sets o)
     @ [ title "messages" "Messages" ]
     @ List.map (item o) (Outline.items o)
     @ [ title "any" "Any message"; Shape.all o; text functions ])
>>>>>>> wt-imc
