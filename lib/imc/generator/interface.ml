open Dolphin_imc_definition
open Definition
open Code

let spf = Printf.sprintf

(* {1 Comments} *)

(* Prose within a documentation comment: the characters that ocamldoc would read are escaped. *)
let prose text =
  let escape = function
    | ('{' | '}' | '[' | ']' | '@') as c -> spf "\\%c" c
    | c -> String.make 1 c
  in
  String.concat "" (List.map escape (List.of_seq (String.to_seq text)))

(* The type on the wire, where the OCaml type does not determine it. *)
let wire_type = function
  | Number (((I8 | U8 | I16 | U16 | I32 | U32 | F32) as scalar), _) -> scalar_name scalar
  | Number ((F64 | I64), _) | Text _ | Raw | Inline _ | List _ -> ""

(* The title, the unit and further text, then the type: "Timeout, s (u16)". *)
let field_comment (f : field) =
  let more =
    match f.typ with
    | Number (_, Quantity named) ->
      List.map (fun (n : named) -> spf "%d is %s" n.value (prose n.name)) named
    | Text { tuples = true } -> [ "tuples" ]
    | Raw -> [ "any bytes" ]
    | Number _ | Text _ | Inline _ | List _ -> []
  in
  let parts = prose f.title :: prose (Option.value f.unit ~default:"") :: more in
  match (String.concat ", " (List.filter (fun part -> part <> "") parts), wire_type f.typ) with
  | "", "" -> ""
  | "", typ -> spf "(** %s. *)" typ
  | text, "" -> spf "(** %s. *)" text
  | text, typ -> spf "(** %s (%s). *)" text typ

let colon title = if title = "" then "" else ": " ^ prose title

(* {1 Sets of values} *)

let enumeration name members =
  let comment (n : named) = spf "(** %d%s. *)" n.value (colon n.title) in
  let body =
    paragraphs
      [ Ocaml_types.enumeration members ~comment; [ line "include Enumeration.S with type t := t" ] ]
  in
  enclosed (spf "module %s : sig" name) body "end"

let bits name members =
  let constant (n : named) =
    [ line "val %s : t" (Names.value n.name); line "(** [0x%X]%s. *)" n.value (colon n.title) ]
  in
  let constants = List.map constant (List.filter Ocaml_types.constant members) in
  enclosed (spf "module %s : sig" name) (paragraphs ([ line "include Bits.S" ] :: constants)) "end"

let set comment = function
  | name, Ocaml_types.Enumeration_of members -> line "%s" (comment "The values") :: enumeration name members
  | name, Ocaml_types.Bits_of members -> line "%s" (comment "The bits") :: bits name members

let shared_set = set (spf "(** %s of fields of several messages. *)")

(* Of the field that has the set for its own. *)
let own_set (m : message) (name, members) =
  let is_its (f : field) = String.equal (Names.module_ f.name) name in
  let title = Option.fold (List.find_opt is_its m.fields) ~none:"" ~some:(fun (f : field) -> colon f.title) in
  set (fun what -> spf "(** %s of a field%s. *)" what title) (name, members)

(* {1 Messages and groups} *)

let message o (m : message) =
  let id = [ line "val id : int  (** [%d]. *)" m.id ] in
  let default =
    [
      line "val default : %st" (Ocaml_types.parameter o (Message m));
      line "(** Every number 0, every text and list empty, no message within. *)";
    ]
  in
  let body =
    match m.fields with
    | [] -> id
    | _ ->
      let sets = List.map (own_set m) (Ocaml_types.own_sets m) in
      paragraphs (sets @ [ Ocaml_types.record o m ~comment:field_comment; id; default ])
  in
  let title = if m.title = "" then "" else prose m.title ^ ". " in
  line "(** %sMessage %d. *)" title m.id
  :: enclosed (spf "module %s : sig" (Names.module_ m.name)) body "end"

let group o (g : group) members =
  let item = Outline.Group (g, members) in
  let body = Ocaml_types.variant o item (List.map (fun m -> Outline.Message m) members) in
  line "(** A message of IMC's group %s. *)" (prose g.name)
  :: enclosed (spf "module %s : sig" (Names.module_ g.name)) body "end"

let item o = function
  | Outline.Message m -> message o m
  | Outline.Group (g, members) -> group o g members

(* {1 The whole} *)

let head =
  {|(** The messages of IMC that Dolphin reads and writes.

    Generated from [messages.def], which names the source. Every message is a module: its record
    [t], its number [id], and [default] to build from: [{ Goto.default with lat; lon }]. A comment
    on a field gives its unit, and in parentheses its type on the wire if OCaml's is wider.

    If a message can contain any other, its type has that as a parameter, ['message]; in {!t}, ['message] is {!t}. *)|}

let functions =
  {|val id : t -> int
(** The number of the message. *)

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
    @raise Reader.Fault if the message is unknown, or the bytes do not form one. *)

val write : Writer.t -> t -> unit
(** [write w m] writes the fields of [m].
    @raise Writer.Fault if [m] cannot be written. *)|}

let text lines = List.map (line "%s") (String.split_on_char '\n' lines)
let title label words = [ line "(** {1:%s %s} *)" label words ]

let code o =
  paragraphs
    ([ text head; title "values" "Values that several messages share" ]
     @ List.map shared_set (Ocaml_types.shared_sets o)
     @ [ title "messages" "Messages" ]
     @ List.map (item o) (Outline.items o)
     @ [ title "any" "Any message"; Ocaml_types.all o; text functions ])
