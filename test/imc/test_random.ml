open Dolphin_imc
open QCheck2.Gen

(* A value as it is on the wire, in no particular order of bytes. *)
type wire = Number of { bytes : int; bits : int64 } | Bytes of string

type message = { id : int; wire : wire list; json : Yojson.Safe.t }

let word n = Number { bytes = 2; bits = Int64.of_int n }

(* {1 Generators} *)

let integer ~bytes ~signed =
  let bits = 8 * bytes in
  let low = if signed then -(1 lsl (bits - 1)) else 0 in
  let high = if signed then (1 lsl (bits - 1)) - 1 else (1 lsl bits) - 1 in
  frequency [ (3, int_range 0 10 >|= min high); (1, oneofl [ low; high ]); (2, int_range low high) ]

let float_json x =
  if Float.is_nan x then `String "NaN"
  else if x = Float.infinity then `String "Infinity"
  else if x = Float.neg_infinity then `String "-Infinity"
  else `Float x

let odd_floats = [ 0.; -0.; nan; infinity; neg_infinity; 1e-310; max_float ]
let float64 = frequency [ (4, float); (1, oneofl odd_floats) ]
let float32 = map (fun x -> Int32.float_of_bits (Int32.bits_of_float x)) float64

(* UTF-8, so that JSON shows it as it is. *)
let odd_texts = [ ""; "olá"; "a=1;b=2"; "\000\031\"\\" ]
let plaintext = oneof [ string_size ~gen:printable (int_bound 12); oneofl odd_texts ]
let rawdata = string_size ~gen:char (int_bound 12)
let hex s = `String (Corpus.to_hex s)

let real bytes bits x = ([ Number { bytes; bits = bits x } ], float_json x)
let text s = [ word (String.length s); Bytes s ]

let rec field depth (f : Facts.field) =
  let number bytes signed =
    let named = List.map fst f.values in
    let n = integer ~bytes ~signed in
    let n = if named = [] then n else frequency [ (3, oneofl named); (1, n) ] in
    map (fun n -> ([ Number { bytes; bits = Int64.of_int n } ], Facts.number f n)) n
  in
  let show =
    match f.typ with
    | "uint8_t" -> number 1 false
    | "uint16_t" -> number 2 false
    | "uint32_t" -> number 4 false
    | "int8_t" -> number 1 true
    | "int16_t" -> number 2 true
    | "int32_t" -> number 4 true
    | "fp32_t" -> map (real 4 (fun x -> Int64.of_int32 (Int32.bits_of_float x))) float32
    | "fp64_t" -> map (real 8 Int64.bits_of_float) float64
    | "plaintext" -> map (fun s -> (text s, `String s)) plaintext
    | "rawdata" -> map (fun s -> (text s, hex s)) rawdata
    | "message" ->
      let none = pure ([ word 0xFFFF ], `Null) in
      if depth = 0 then none
      else
        let some = map (fun m -> (word m.id :: m.wire, m.json)) (inner depth f) in
        frequency [ (1, none); (3, some) ]
    | "message-list" ->
      let list ms =
        let element m = word m.id :: m.wire in
        (word (List.length ms) :: List.concat_map element ms, `List (List.map (fun m -> m.json) ms))
      in
      if depth = 0 then pure (list []) else map list (list_size (int_bound 3) (inner depth f))
    | typ -> failwith typ
  in
  map (fun (wire, json) -> (wire, (f.name, json))) show

and inner depth f = oneofl (Facts.admitted f.restriction) >>= message (depth - 1)

and message depth (m : Facts.message) =
  let assemble fields =
    let json = `Assoc (("abbrev", `String m.name) :: List.map snd fields) in
    { id = m.id; wire = List.concat_map fst fields; json }
  in
  map assemble (flatten_l (List.map (field depth) m.fields))

let any = delay (fun () -> oneofl (Lazy.force Facts.messages) >>= message 3)

(* {1 Bytes} *)

let bytes (order : Byte_order.t) wire =
  let buffer = Buffer.create 256 in
  let byte bits i =
    Buffer.add_uint8 buffer (Int64.to_int (Int64.shift_right_logical bits (8 * i)) land 0xFF)
  in
  let add = function
    | Bytes s -> Buffer.add_string buffer s
    | Number { bytes; bits } ->
      let places = List.init bytes Fun.id in
      List.iter (byte bits) (match order with Little_endian -> places | Big_endian -> List.rev places)
  in
  List.iter add wire;
  Buffer.contents buffer

let datagram order m =
  let number bytes n = Number { bytes; bits = Int64.of_int n } in
  let time = Number { bytes = 8; bits = Int64.bits_of_float 1700000000.25 } in
  let header =
    [ word 0xFE54; word m.id; word 0; time; word 0x4001; number 1 3; word 0x1A; number 1 255 ]
  in
  Corpus.seal (bytes order (header @ m.wire @ [ word 0 ]))

let print m = Yojson.Safe.pretty_to_string m.json
let small m = String.length (bytes Little_endian m.wire) <= 0xFFFF

(* {1 Laws} *)

let shows m =
  let shows order = Yojson.Safe.equal m.json (Check.message_json (Check.decoded (datagram order m))) in
  shows Little_endian && shows Big_endian

let returns m =
  let returns order =
    let s = datagram order m in
    String.equal s (Check.encoded (Check.decoded s))
  in
  returns Little_endian && returns Big_endian

let turns m =
  let p = Check.decoded (datagram Little_endian m) in
  let q = Check.other_order p in
  String.equal (datagram Big_endian m) (Check.encoded q)
  && Packet.equal q (Check.decoded (Check.encoded q))

let dynamic m =
  let definition = Lazy.force Definition.builtin in
  match Dynamic.decode definition Big_endian ~id:m.id (bytes Big_endian m.wire) with
  | Ok m' -> Yojson.Safe.equal m.json (Dynamic.to_json m')
  | Error _ -> false

let law name law = Test_support.Property.case ~count:2000 name ~print any (fun m -> QCheck2.assume (small m); law m)

let suite =
  [
    law "a message shows as what it was made of" shows;
    law "decode, encode: the same bytes" returns;
    law "encode, decode: the same packet, in either order" turns;
    law "the definition read at run time agrees" dynamic;
  ]
