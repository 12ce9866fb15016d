module Utf8 = Dolphin_utf8.Utf8
module Property = Test_support.Property
module Gen = QCheck2.Gen

(* OCaml's own decoder takes what its encoder makes; each scalar value is tried. *)
let encoded code =
  let buffer = Buffer.create 4 in
  Buffer.add_utf_8_uchar buffer (Uchar.of_int code);
  Buffer.contents buffer

let every_character () =
  for code = 0 to 0x10FFFF do
    if Uchar.is_valid code then begin
      let text = encoded code in
      let control = code < 0x20 || (code >= 0x7F && code <= 0x9F) in
      if Utf8.length text 0 <> String.length text then Alcotest.failf "U+%04X has no length" code;
      if Utf8.is_control text 0 <> control then Alcotest.failf "U+%04X as a control character" code;
      let is_unfit =
        control || (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069)
        || code = 0xFFFE || code = 0xFFFF
      in
      if Utf8.is_unfit text 0 <> is_unfit then Alcotest.failf "U+%04X as a character for people" code;
      if String.length text > 1 && Utf8.is_valid (String.sub text 0 (String.length text - 1)) then
        Alcotest.failf "U+%04X cut short" code
    end
  done

(* By value: no surrogates, nothing longer than needed, nothing beyond U+10FFFF. *)
let two_bytes_or_three () =
  let seen = Hashtbl.create 65536 in
  for code = 0 to 0xFFFF do
    if Uchar.is_valid code then Hashtbl.replace seen (encoded code) ()
  done;
  let is_alone text = Hashtbl.mem seen text in
  for a = 0 to 255 do
    for b = 0 to 255 do
      let pair = Printf.sprintf "%c%c" (Char.chr a) (Char.chr b) in
      if (Utf8.length pair 0 = 2) <> is_alone pair then Alcotest.failf "%S" pair;
      List.iter
        (fun c ->
           let triple = Printf.sprintf "%s%c" pair c in
           if (Utf8.length triple 0 = 3) <> is_alone triple then Alcotest.failf "%S" triple)
        [ '\x00'; '\x7F'; '\x80'; '\xBF'; '\xC0'; '\xFF' ]
    done
  done

let wrong () =
  List.iter
    (fun (text, strays) ->
       Alcotest.(check bool) (String.escaped text) false (Utf8.is_valid text);
       Alcotest.(check int) (String.escaped text) strays (Utf8.strays text))
    [ ("\x80", 1); ("\xC0\x80", 2); ("\xE0\x80\x80", 3); ("\xED\xA0\x80", 3); ("\xF4\x90\x80\x80", 4); ("\xF0\x90\x80", 3);
      ("a\xFFb", 1); ("\xC3", 1); ("\xC3\xA9\xC3", 1) ];
  Alcotest.(check int) "outside" 0 (Utf8.length "a" 1)

let texts =
  let open Gen in
  let character = map encoded (oneof [ int_bound 0xD7FF; int_range 0xE000 0x10FFFF; int_bound 0xA0 ]) in
  map (String.concat "") (list_size (int_bound 8) (oneof [ character; string_size ~gen:char (int_bound 3) ]))

let case name law = Property.case ~count:2000 name ~print:String.escaped texts law
let is_line text = not (String.exists (fun c -> c < ' ' || c = '\x7F') text)

let is_fit text =
  List.for_all (fun i -> not (Utf8.is_unfit text i)) (List.init (String.length text) Fun.id)


let laws =
  [ case "repaired texts are valid, and valid texts stay" (fun text ->
        let repaired = Utf8.repaired text in
        Utf8.is_valid repaired && (repaired = text) = Utf8.is_valid text
        && String.length repaired = String.length text + (2 * Utf8.strays text));
    case "a line is valid, has no control characters, and stays as it is" (fun text ->
        let line = Utf8.line text in
        Utf8.is_valid line && is_line line && is_fit line && Utf8.line line == line) ]

let () =
  let case name test = Alcotest.test_case name `Quick test in
  Alcotest.run "utf8"
    [ ( "characters",
        [ case "every character" every_character; case "two and three bytes" two_bytes_or_three; case "no text" wrong ] );
      ("texts", laws) ]
