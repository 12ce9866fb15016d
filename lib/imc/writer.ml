exception Fault of Error.encode

type t = { buffer : Buffer.t; big : bool; mutable depth : int }

let make (order : Byte_order.t) buffer =
  let big = match order with Big_endian -> true | Little_endian -> false in
  { buffer; big; depth = 0 }

let fault fault = raise_notrace (Fault fault)
let check field ~low ~high value = if value < low || value > high then fault (Out_of_range { field; value })

let u8 w field n =
  check field ~low:0 ~high:0xFF n;
  Buffer.add_uint8 w.buffer n

let i8 w field n =
  check field ~low:(-0x80) ~high:0x7F n;
  Buffer.add_int8 w.buffer n

let bits16 w n = if w.big then Buffer.add_uint16_be w.buffer n else Buffer.add_uint16_le w.buffer n
let bits32 w n = if w.big then Buffer.add_int32_be w.buffer n else Buffer.add_int32_le w.buffer n
let i64 w n = if w.big then Buffer.add_int64_be w.buffer n else Buffer.add_int64_le w.buffer n

let u16 w field n =
  check field ~low:0 ~high:0xFFFF n;
  bits16 w n

let i16 w field n =
  check field ~low:(-0x8000) ~high:0x7FFF n;
  bits16 w n

let u32 w field n =
  check field ~low:0 ~high:0xFFFF_FFFF n;
  bits32 w (Int32.of_int n)

let i32 w field n =
  check field ~low:(-0x8000_0000) ~high:0x7FFF_FFFF n;
  bits32 w (Int32.of_int n)

let f32 w x = bits32 w (Int32.bits_of_float x)
let f64 w x = i64 w (Int64.bits_of_float x)

let length w field n =
  if n > 0xFFFF then fault (Too_long { field; length = n });
  bits16 w n

let text w field s =
  length w field (String.length s);
  Buffer.add_string w.buffer s

let nested w field write m =
  if w.depth >= Error.max_depth then fault (Nested_too_deep { field });
  w.depth <- w.depth + 1;
  write w m;
  w.depth <- w.depth - 1

let inline w field write = function None -> bits16 w 0xFFFF | Some m -> nested w field write m

let list w field write messages =
  length w field (List.length messages);
  List.iter (nested w field write) messages

let tagged id write w m =
  bits16 w id;
  write w m
