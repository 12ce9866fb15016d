open Dolphin_imc

let json = Alcotest.testable (Yojson.Safe.pretty_print ~std:false) Yojson.Safe.equal

let get ~pp what = function
  | Ok value -> value
  | Error error -> Alcotest.failf "%s: %a" what pp error

let decoded s = get ~pp:Error.pp_decode (Corpus.to_hex s) (Packet.decode s)
let encoded p = get ~pp:Error.pp_encode "encode" (Packet.encode p)

let message_json (p : Packet.t) =
  match p.content with
  | Message m -> Message.to_json m
  | Unknown { id; _ } -> Alcotest.failf "message %d is unknown" id

let other_order (p : Packet.t) =
  { p with order = (match p.order with Little_endian -> Big_endian | Big_endian -> Little_endian) }
