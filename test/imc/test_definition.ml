open Dolphin_imc
open Dolphin_imc_definition

let check = Alcotest.check
let case name run = Alcotest.test_case name `Quick run
let builtin () = Lazy.force Dolphin_imc.Definition.builtin

(* {1 The built-in definition} *)

let scalar = function
  | "uint8_t" -> "u8"
  | "uint16_t" -> "u16"
  | "uint32_t" -> "u32"
  | "int8_t" -> "i8"
  | "int16_t" -> "i16"
  | "int32_t" -> "i32"
  | "int64_t" -> "i64"
  | "fp32_t" -> "f32"
  | "fp64_t" -> "f64"
  | typ -> typ

let values_of named = List.map (fun (n : Definition.named) -> (n.value, n.name)) named

let same_field name (f : Facts.field) (d : Definition.field) =
  let where = name ^ "." ^ f.name in
  let unit, restriction, typ, values =
    match d.typ with
    | Number (s, Quantity exceptions) -> (d.unit, None, Definition.scalar_name s, values_of exceptions)
    | Number (s, Enumeration { members; _ }) ->
      (Some "Enumerated", None, Definition.scalar_name s, values_of members)
    | Number (s, Bits { members; _ }) -> (Some "Bitfield", None, Definition.scalar_name s, values_of members)
    | Text { tuples } -> ((if tuples then Some "TupleList" else None), None, "plaintext", [])
    | Raw -> (None, None, "rawdata", [])
    | Inline restriction -> (None, restriction, "message", [])
    | List restriction -> (None, restriction, "message-list", [])
  in
  check Alcotest.string where f.name d.name;
  check Alcotest.string where (scalar f.typ) typ;
  check Alcotest.(option string) where f.unit unit;
  check Alcotest.(option string) where f.restriction restriction;
  check Alcotest.(list (pair int string)) where f.values values

let facts () =
  let messages = Lazy.force Facts.messages in
  check Alcotest.int "messages" 123 (List.length messages);
  check Alcotest.int "messages" 123 (List.length (Definition.messages (builtin ())));
  let same (m : Facts.message) =
    match Definition.find (builtin ()) m.id with
    | None -> Alcotest.failf "no message %d" m.id
    | Some d ->
      check Alcotest.string "name" m.name d.name;
      check Alcotest.int m.name (List.length m.fields) (List.length d.fields);
      List.iter2 (same_field m.name) m.fields d.fields
  in
  List.iter same messages;
  let group (g : Definition.group) = (g.name, List.sort compare g.members) in
  let sorted (name, members) = (name, List.sort compare members) in
  let stated = List.map sorted (Lazy.force Facts.groups) in
  check Alcotest.(list (pair string (list string))) "groups" stated
    (List.map group (Definition.groups (builtin ())))

let known () =
  for id = 0 to 0xFFFF do
    let defined = Option.is_some (Definition.find (builtin ()) id) in
    if Message.is_known id <> defined then Alcotest.failf "message %d" id
  done

let parse text = Def_file.parse text

let print_parse () =
  let page = Format.asprintf "%a" Definition.pp (builtin ()) in
  let again = Check.get ~pp:Def_file.pp_error "parse" (parse page) in
  check Alcotest.bool "the same definition" true (again = builtin ())

let faults () =
  let fails text expected =
    match parse text with
    | Ok _ -> Alcotest.failf "accepted: %s" text
    | Error e -> check Alcotest.string text expected (Format.asprintf "%a" Def_file.pp_error e)
  in
  fails "message x A" "line 1: x is not a number";
  fails "message 1 A\n  x u9" "line 2: u9 is not a type that can stand here";
  fails "message 1 A\n   x u8" "line 2: indented by 3 blanks instead of at most 2";
  fails "\nmessage 1 A\n  x u8 enum E" "line 3: no set of values is named E";
  fails "message 1 A\n  x text\n    1 ONE" "line 2: nothing can be indented under this line";
  fails "thing" "line 1: expected enum NAME, bits NAME, group NAME, or message ID NAME";
  fails "message 1 A\nmessage 1 B" "message B: the id 1 is taken";
  fails "message 1 A\nmessage 2 A" "message A is defined twice";
  fails "message 65535 A" "message A: the id 65535 is not in 0 .. 65534";
  fails "message 1 A\n  x list B" "A.x: no message or group is named B";
  fails "group G\n  A" "group G: no message is named A"

(* {1 A user's definition} *)

let sample () =
  Check.get ~pp:Imc_xml.pp_error "sample.xml" (Dolphin_imc.Definition.of_imc_xml "data/sample.xml")

(* The content of a message of the flood that the library does not have. *)
let flood () =
  let definition = sample () in
  let show s =
    let p = Check.decoded s in
    match (p.content, Dynamic.packet_to_json definition p) with
    | Unknown { id = 281; _ }, json -> (
        match Yojson.Safe.Util.member "message" json with
        | `Assoc [ ("abbrev", `String "ServoPosition"); ("id", `Int servo); ("value", `Float angle) ] ->
          if servo > 3 || Float.abs angle > 1.6 then Alcotest.failf "servo %d at %g rad" servo angle;
          1
        | _ -> Alcotest.fail "not a servo position")
    | _ -> 0
  in
  check Alcotest.int "servo positions" 1521
    (List.fold_left (fun n s -> n + show s) 0 (Lazy.force Corpus.flood))

let everything () =
  let payload =
    "\xFF\xFE\xFF\xFD\xFF\xFF\xFF\xFC\xFF\xFF\xFF\xFF\xFF\xFF\xFF" (* -1, -2, -3, -4 *)
    ^ "\x01" ^ "\x07\x00" ^ "\x07\x00\x00\x00" (* ON; both lights and a third; SEVEN *)
    ^ "\x03\x00a=1" ^ "\x02\x00\xFF\x00" ^ "\xFF\xFF" ^ "\x01\x00\x19\x01\x02\x00\x00\x80\x3F"
  in
  let decode s = Dynamic.decode (sample ()) Little_endian ~id:3000 s in
  let expected =
    {|{"abbrev":"Everything","a":-1,"b":-2,"c":-3,"d":-4,"e":"ON","f":["PORT","STARBOARD","0x4"],"g":"SEVEN",
       "h":"a=1","i":"ff00","j":null,"k":[{"abbrev":"ServoPosition","id":2,"value":1.0}]}|}
  in
  let m = Check.get ~pp:Error.pp_decode "everything" (decode payload) in
  check Alcotest.string "shown" (Yojson.Safe.to_string (Yojson.Safe.from_string expected))
    (Yojson.Safe.to_string (Dynamic.to_json m));
  for length = 0 to String.length payload - 1 do
    match decode (String.sub payload 0 length) with
    | Error (Bad_payload { fault = Overrun; _ }) -> ()
    | Ok _ | Error _ -> Alcotest.failf "%d bytes" length
  done

let xml_faults () =
  let fails text expected =
    match Imc_xml.parse text with
    | Ok _ -> Alcotest.failf "accepted: %s" text
    | Error e -> check Alcotest.string text expected (Format.asprintf "%a" Imc_xml.pp_error e)
  in
  fails "<imc/>" "1:5: expected <messages>, the root of an IMC.xml, and found <imc>";
  fails "<messages><message abbrev='A'/></messages>" "1:30: <message>: the attribute id is missing";
  fails "<messages>\n <message id='one' abbrev='A'/></messages>"
    "2:30: <message>: the attribute id is one, not a number";
  fails "<messages><message id='1' abbrev='A'><field abbrev='x' type='float'/></message></messages>"
    "1:68: <field>: float is not a type of IMC";
  fails "<messages><message id='1' abbrev='A'/><message id='1' abbrev='B'/></messages>"
    "1:65: message B: the id 1 is taken";
  fails "<messages><message id='1' abbrev='A'/>\n<message id='2' abbrev='A'/></messages>"
    "2:27: message A is defined twice";
  (match Imc_xml.parse "<messages>" with
   | Ok _ -> Alcotest.fail "accepted: not closed"
   | Error { line; _ } -> check Alcotest.int "line" 1 line);
  match Dolphin_imc.Definition.of_imc_xml "data/none.xml" with
  | Ok _ -> Alcotest.fail "read a file that is not there"
  | Error e -> check Alcotest.string "error" "data/none.xml: No such file or directory" e.why

let suite =
  [
    case "messages.def = the facts" facts;
    case "Message.is_known" known;
    case "print, parse: the same" print_parse;
    case "faults in a page" faults;
    case "IMC.xml: the flood's unknown messages" flood;
    case "IMC.xml: every type" everything;
    case "faults in an IMC.xml" xml_faults;
  ]
