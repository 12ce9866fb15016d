let mark = "\xef\xbb\xbf"

let without_mark text =
  if String.starts_with ~prefix:mark text then String.sub text 3 (String.length text - 3) else text

(* How many bytes the character at [i] has, 0 if none begins there: table 3-7 of the Unicode standard. *)
let length_at text i =
  let byte n = if i + n < String.length text then Char.code text.[i + n] else 0 in
  let follows n = byte n land 0xC0 = 0x80 in
  let second low high = low <= byte 1 && byte 1 <= high in
  match byte 0 with
  | b when b < 0x80 -> 1
  | b when 0xC2 <= b && b <= 0xDF && follows 1 -> 2
  | 0xE0 when second 0xA0 0xBF && follows 2 -> 3
  | 0xED when second 0x80 0x9F && follows 2 -> 3
  | b when 0xE1 <= b && b <= 0xEF && b <> 0xED && follows 1 && follows 2 -> 3
  | 0xF0 when second 0x90 0xBF && follows 2 && follows 3 -> 4
  | 0xF4 when second 0x80 0x8F && follows 2 && follows 3 -> 4
  | b when 0xF1 <= b && b <= 0xF3 && follows 1 && follows 2 && follows 3 -> 4
  | _ -> 0

let rec first_bad text i =
  if i >= String.length text then None
  else match length_at text i with 0 -> Some i | n -> first_bad text (i + n)

let repaired text =
  match first_bad text 0 with
  | None -> (text, 0)
  | Some first ->
    let b = Buffer.create (String.length text + 16) in
    Buffer.add_substring b text 0 first;
    let rec go i count =
      if i >= String.length text then count
      else
        match length_at text i with
        | 0 -> Buffer.add_string b "\xef\xbf\xbd"; go (i + 1) (count + 1)
        | n -> Buffer.add_substring b text i n; go (i + n) count
    in
    let count = go first 0 in
    (Buffer.contents b, count)

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

let of_windows_1252 text =
  let b = Buffer.create (String.length text + 64) in
  String.iter
    (fun c ->
       let n = Char.code c in
       Buffer.add_utf_8_uchar b (Uchar.of_int (if 0x80 <= n && n <= 0x9F then upper.(n - 0x80) else n)))
    text;
  Buffer.contents b
