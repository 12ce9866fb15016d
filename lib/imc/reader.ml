exception Fault of { at : int; fault : Error.fault }

type t = {
  data : string;
  start : int;
  stop : int;  (* [start <= next <= stop <= String.length data] *)
  big : bool;
  mutable next : int;
  mutable depth : int;
}

let make (order : Byte_order.t) data ~pos ~len =
  let big = match order with Big_endian -> true | Little_endian -> false in
  { data; start = pos; stop = pos + len; big; next = pos; depth = 0 }

let fault r fault = raise_notrace (Fault { at = r.next - r.start; fault })
let unknown r id = fault r (Unknown_message id)
let misplaced r id expected = fault r (Misplaced { id; expected })
let finish r = if r.next < r.stop then fault r (Leftover (r.stop - r.next))

(* [take r n] is the position of the next [n] bytes, which are then behind the reader. *)
let take r n =
  let at = r.next in
  if n > r.stop - at then fault r Overrun;
  r.next <- at + n;
  at

let u8 r = String.get_uint8 r.data (take r 1)
let i8 r = String.get_int8 r.data (take r 1)

let u16 r =
  let at = take r 2 in
  if r.big then String.get_uint16_be r.data at else String.get_uint16_le r.data at

let i16 r =
  let at = take r 2 in
  if r.big then String.get_int16_be r.data at else String.get_int16_le r.data at

let bits32 r =
  let at = take r 4 in
  if r.big then String.get_int32_be r.data at else String.get_int32_le r.data at

let i64 r =
  let at = take r 8 in
  if r.big then String.get_int64_be r.data at else String.get_int64_le r.data at

let i32 r = Int32.to_int (bits32 r)
let u32 r = i32 r land 0xFFFF_FFFF
let f32 r = Int32.float_of_bits (bits32 r)
let f64 r = Int64.float_of_bits (i64 r)

let text r =
  let length = u16 r in
  String.sub r.data (take r length) length

let nested r read id =
  if r.depth >= Error.max_depth then fault r Too_deep;
  r.depth <- r.depth + 1;
  let m = read r id in
  r.depth <- r.depth - 1;
  m

let inline r read = match u16 r with 0xFFFF -> None | id -> Some (nested r read id)

let list r read =
  let count = u16 r in
  (* Each message takes the two bytes of its id at least: a count that cannot be true ends here. *)
  if 2 * count > r.stop - r.next then fault r Overrun;
  let rec loop n messages =
    if n = 0 then List.rev messages else loop (n - 1) (nested r read (u16 r) :: messages)
  in
  loop count []

let only name id read r id' = if id' = id then read r else misplaced r id' name
