open Yojson.Safe.Util

type vector = { name : string; little : string; big : string; content : Yojson.Safe.t }

let text name =
  let channel = open_in_bin (Filename.concat "data" name) in
  Fun.protect
    ~finally:(fun () -> close_in channel)
    (fun () -> really_input_string channel (in_channel_length channel))

let json_lines name =
  let lines = String.split_on_char '\n' (text name) in
  List.filter_map (fun line -> if line = "" then None else Some (Yojson.Safe.from_string line)) lines

let of_hex hex =
  String.init (String.length hex / 2) (fun i -> Char.chr (int_of_string ("0x" ^ String.sub hex (2 * i) 2)))

let to_hex s =
  String.concat "" (List.map (fun c -> Printf.sprintf "%02x" (Char.code c)) (List.of_seq (String.to_seq s)))

let vectors =
  lazy
    (let vector json =
       let bytes key = of_hex (to_string (member key json)) in
       { name = to_string (member "abbrev" json); little = bytes "le"; big = bytes "be"; content = json }
     in
     List.map vector (json_lines "vectors.jsonl"))

(* By the size in each header; not by the code under test. All recorded packets are little-endian. *)
let packets name =
  let s = text name in
  let rec split pos =
    if pos = String.length s then []
    else
      let length = 22 + String.get_uint16_le s (pos + 4) in
      String.sub s pos length :: split (pos + length)
  in
  split 0

let lifecycle = lazy (packets "lifecycle.imc")
let flood = lazy (packets "flood.imc")

let datagrams =
  lazy
    (let of_vector v = [ v.little; v.big ] in
     Lazy.force lifecycle @ Lazy.force flood @ List.concat_map of_vector (Lazy.force vectors))

(* Bit by bit, unlike the library. *)
let crc s =
  let bit crc = if crc land 1 = 1 then (crc lsr 1) lxor 0xA001 else crc lsr 1 in
  let byte crc c =
    let rec bits n crc = if n = 0 then crc else bits (n - 1) (bit crc) in
    bits 8 (crc lxor Char.code c)
  in
  Seq.fold_left byte 0 (String.to_seq s)

let seal s =
  let length = String.length s in
  if length < 22 || length > 22 + 0xFFFF then s
  else
    let b = Bytes.of_string s in
    let set = if s.[0] = '\xFE' then Bytes.set_uint16_be else Bytes.set_uint16_le in
    set b 4 (length - 22);
    set b (length - 2) (crc (Bytes.sub_string b 0 (length - 2)));
    Bytes.to_string b
