(* The rendering of diagnostics and their suggestions. *)

open Dolphin_syntax

let shown name ~source ~first ~last expected =
  Alcotest.test_case name `Quick (fun () ->
      let cursor = Cursor.make ~file:"f.dol" source in
      let start = Cursor.position cursor first in
      let at = Location.make (start, Cursor.position cursor last) in
      let text = Format.asprintf "@[<v>%a@]" (Diagnostic.pp ~source) (Diagnostic.error at "wrong" ~hint:"right") in
      Alcotest.(check string) name expected text)

let long = String.make 200 'a' ^ "!!" ^ String.make 200 'b'

let pp =
  [ shown "plain" ~source:"x = 1\ny = ab\n" ~first:10 ~last:12
      "f.dol:2:5: error: wrong\n  2 | y = ab\n    |     ^^\n    hint: right";
    shown "tabs" ~source:"\tx = 1" ~first:1 ~last:2
      "f.dol:1:2: error: wrong\n  1 |     x = 1\n    |     ^\n    hint: right";
    shown "UTF-8" ~source:"'é€' + b" ~first:10 ~last:11
      "f.dol:1:8: error: wrong\n  1 | 'é€' + b\n    |        ^\n    hint: right";
    shown "several lines" ~source:"ab\ncd" ~first:1 ~last:4
      "f.dol:1:2: error: wrong\n  1 | ab\n    |  ^\n    hint: right";
    shown "the end" ~source:"ab" ~first:2 ~last:2 "f.dol:1:3: error: wrong\n  1 | ab\n    |   ^\n    hint: right";
    shown "an empty text" ~source:"" ~first:0 ~last:0 "f.dol:1:1: error: wrong\n  1 | \n    | ^\n    hint: right";
    shown "a long line" ~source:long ~first:200 ~last:202
      (Printf.sprintf "f.dol:1:201: error: wrong\n  1 | ...%s!!%s...\n    | %s^^\n    hint: right" (String.make 50 'a')
         (String.make 58 'b') (String.make 53 ' ')) ]

(* A text that is not UTF-8 and commands terminals, in the program and in its diagnostic. *)
let printed =
  Alcotest.test_case "nothing but printable characters" `Quick (fun () ->
      let source = "a\xE1\xD5\xF4\x1b[2J\xC2\x9b\xE2\x82\xACz" in
      let cursor = Cursor.make ~file:"f.dol" source in
      let at = Location.make (Cursor.position cursor 0, Cursor.position cursor 1) in
      let text = Format.asprintf "@[<v>%a@]" (Diagnostic.pp ~source) (Diagnostic.error at source ~hint:source) in
      let shown = "a????[2J?\xE2\x82\xACz" in
      Alcotest.(check string) "text"
        (Printf.sprintf "f.dol:1:1: error: %s\n  1 | %s\n    | ^\n    hint: %s" shown shown shown)
        text)

let placeless =
  Alcotest.test_case "without a place" `Quick (fun () ->
      let warning = Diagnostic.warning Unused_task Location.none "wrong" ~hint:"right" in
      let text = Format.asprintf "@[<v>%a@]" (Diagnostic.pp ~source:"") warning in
      Alcotest.(check string) "text" "warning: wrong\n  hint: right" text)

let suggested x xs expected =
  Alcotest.test_case ("suggest " ^ x) `Quick (fun () ->
      Alcotest.(check (option string)) x expected (Diagnostic.suggest x xs))

let suggest =
  [ suggested "mesage" [ "post"; "message"; "pause" ] (Some "message");
    suggested "pasue" [ "post"; "pause" ] (Some "pause");
    suggested "uuvs" [ "UAV"; "UUVs" ] (Some "UUVs"); suggested "x" [ "y"; "z" ] None; suggested "abc" [ "xyz" ] None;
    suggested "execute" [ "exeucte"; "execte" ] (Some "exeucte"); suggested "a" [] None;
    suggested (String.make 10_000 'a') [ "a" ] None ]

let suite = pp @ [ printed; placeless ] @ suggest
