(* Every written text is JSON; texts that are not JSON are not read. *)

open Dolphin_json
module Utf8 = Dolphin_utf8.Utf8

(* UTF-8 by the standard's table of well-formed byte sequences, as a regular expression reads it. *)
let rec is_utf8 = function
  | [] -> true
  | a :: rest when a < 0x80 -> is_utf8 rest
  | a :: b :: rest when a >= 0xC2 && a <= 0xDF && b land 0xC0 = 0x80 -> is_utf8 rest
  | a :: b :: c :: rest when a land 0xF0 = 0xE0 && b land 0xC0 = 0x80 && c land 0xC0 = 0x80 ->
    let code = ((a land 0x0F) lsl 12) lor ((b land 0x3F) lsl 6) lor (c land 0x3F) in
    code >= 0x800 && not (code >= 0xD800 && code <= 0xDFFF) && is_utf8 rest
  | a :: b :: c :: d :: rest
    when a land 0xF8 = 0xF0 && b land 0xC0 = 0x80 && c land 0xC0 = 0x80 && d land 0xC0 = 0x80 ->
    let code =
      ((a land 0x07) lsl 18) lor ((b land 0x3F) lsl 12) lor ((c land 0x3F) lsl 6) lor (d land 0x3F) in
    code >= 0x10000 && code <= 0x10FFFF && is_utf8 rest
  | _ -> false

let bytes text = List.map Char.code (List.of_seq (String.to_seq text))

let string =
  let open QCheck2.Gen in
  let piece = oneof [ string_size ~gen:char (int_bound 4); oneofl [ "\xC3\xA9"; "\xED\xA0\x80"; "\xF0\x9F\x90\xAC"; "\xC0\x80" ] ] in
  map (String.concat "") (list_size (int_bound 6) piece)

let float = QCheck2.Gen.(oneof [ float; oneofl [ infinity; neg_infinity; nan; 1e308; 0. ] ])

let json =
  let open QCheck2.Gen in
  sized_size (int_bound 4) @@ fix @@ fun self n : Yojson.Safe.t t ->
  let leaf = oneof [ map (fun s -> `String s) string; map (fun x -> `Float x) float; return `Null ] in
  if n = 0 then leaf
  else
    oneof
      [ leaf; map (fun xs -> `List xs) (list_size (int_bound 3) (self (n - 1)));
        map (fun xs -> `Assoc xs) (list_size (int_bound 3) (pair string (self (n - 1)))) ]

let written_is_json json =
  let text = Canonical.to_string json in
  is_utf8 (bytes text) && Result.is_ok (Host_value.parse text)

let validity_agrees text = Utf8.is_valid text = is_utf8 (bytes text)
let repaired_is_valid text = is_utf8 (bytes (Utf8.repaired text)) && (Utf8.repaired text = text) = is_utf8 (bytes text)

let refused text =
  Alcotest.test_case (String.escaped text) `Quick (fun () ->
      Alcotest.(check bool) "is refused" true (Result.is_error (Host_value.parse text)))

(* {1 Each writer of texts}

   Whatever strings and numbers they are given, their lines are JSON in UTF-8, and have no NaN or infinity. *)

let is_json text = is_utf8 (bytes text) && Result.is_ok (Host_value.parse text)

let graph label =
  let b = Dolphin_lts.Graph.Builder.create () in
  Dolphin_lts.Graph.Builder.add b 0 label 1;
  Dolphin_lts_json.Graph_json.to_string (Dolphin_lts.Graph.Builder.finish ~initial:0 ~states:2 ~text:(fun _ -> label) b)

let report text x =
  let open Dolphin_platform_protocol.Report in
  to_line (Request (text, Progress { share = Some x; remaining = Some x }))
  ^ to_line (Log { vehicle = Some text; text })
  ^ to_line (Note { request = text; note = `Assoc [ (text, `Float x) ]; id = None })

let order text x =
  let open Dolphin_platform_protocol.Order in
  to_line (Start { request = text; vehicle = text; plan = `Assoc [ ("name", `String text); ("speed", `Float x) ];
                   timeout = x })
  ^ to_line (Timeout (Some [ text ], x))

let entry text x =
  let vehicle = Dolphin_trace.Entry.Note { time = 0.; vehicle = text; note = `Assoc [ (text, `Float x) ] } in
  Dolphin_trace.Entry.to_string vehicle ^ "\n"
  ^ Dolphin_trace.Entry.to_string (Label { time = 0.; label = text })

let lines text = List.filter (fun line -> line <> "") (String.split_on_char '\n' text)

let writers_are_valid (text, x) =
  is_json (graph text)
  && List.for_all is_json (List.concat_map lines [ report text x; order text x; entry text x ])
  && is_json (Canonical.to_lines (`Assoc [ (text, `List [ `Float x; `String text ]) ]))

let () =
  let case name ~print generator law = Test_support.Property.case ~count:1000 name ~print generator law in
  Alcotest.run "json"
    [ ( "texts",
        [ case "UTF-8 by the standard's table" ~print:String.escaped string validity_agrees;
          case "repaired texts are valid" ~print:String.escaped string repaired_is_valid;
          case "what is written is read" ~print:(fun json -> String.escaped (Yojson.Safe.to_string json)) json
            written_is_json;
          case "lines of graphs, platforms and journals"
            ~print:(fun (text, x) -> Printf.sprintf "%S, %h" text x)
            (QCheck2.Gen.pair string float) writers_are_valid ] );
      ( "not JSON",
        List.map refused
          [ "1e999"; "[-1e999]"; "NaN"; "{\"a\": Infinity}"; "\"\xFF\""; "{\"\xC3\": 1}"; "[\"\xED\xA0\x80\"]" ] ) ]
