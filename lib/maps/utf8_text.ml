module Utf8 = Dolphin_utf8.Utf8

let mark = "\xef\xbb\xbf"

let without_mark text =
  if String.starts_with ~prefix:mark text then String.sub text 3 (String.length text - 3) else text

let repaired text = (Utf8.repaired text, Utf8.strays text)

(* The controls of ASCII, and U+0080 to U+009F. *)
let harmless text =
  let bytes = Bytes.of_string (fst (repaired text)) in
  Bytes.iteri
    (fun i c ->
       let is_second_of_control = i > 0 && Bytes.get bytes (i - 1) = '\xc2' && c >= '\x80' && c <= '\x9f' in
       if is_second_of_control then begin
         Bytes.set bytes (i - 1) ' ';
         Bytes.set bytes i ' '
       end
       else if c < ' ' || c = '\127' then Bytes.set bytes i ' ')
    bytes;
  String.trim (Bytes.to_string bytes)

(* Of 0x80 to 0x9F; the five that are not assigned are themselves. *)
let upper =
  [| 0x20AC; 0x81; 0x201A; 0x192; 0x201E; 0x2026; 0x2020; 0x2021; 0x2C6; 0x2030; 0x160; 0x2039; 0x152; 0x8D; 0x17D;
     0x8F; 0x90; 0x2018; 0x2019; 0x201C; 0x201D; 0x2022; 0x2013; 0x2014; 0x2DC; 0x2122; 0x161; 0x203A; 0x153; 0x9D;
     0x17E; 0x178 |]

let of_bytes character text =
  let b = Buffer.create (String.length text + 64) in
  String.iter (fun c -> Buffer.add_utf_8_uchar b (Uchar.of_int (character (Char.code c)))) text;
  Buffer.contents b

let of_windows_1252 = of_bytes (fun n -> if 0x80 <= n && n <= 0x9F then upper.(n - 0x80) else n)

let of_iso_8859_15 =
  of_bytes (function
      | 0xA4 -> 0x20AC
      | 0xA6 -> 0x160
      | 0xA8 -> 0x161
      | 0xB4 -> 0x17D
      | 0xB8 -> 0x17E
      | 0xBC -> 0x152
      | 0xBD -> 0x153
      | 0xBE -> 0x178
      | n -> n)
