type t = {
  order : Byte_order.t;
  id : int;
  size : int;
  timestamp : float;
  src : int;
  src_ent : int;
  dst : int;
  dst_ent : int;
}

let size = 20
let overhead = 22
let broadcast = 0xFFF0
let nobody = 0xFFFF
let any_entity = 255

let u16 (order : Byte_order.t) s at =
  match order with
  | Little_endian -> String.get_uint16_le s at
  | Big_endian -> String.get_uint16_be s at

let f64 (order : Byte_order.t) s at =
  Int64.float_of_bits
    (match order with
     | Little_endian -> String.get_int64_le s at
     | Big_endian -> String.get_int64_be s at)

(* The 22 bytes from [pos] are there. *)
let fields order s pos =
  {
    order;
    id = u16 order s (pos + 2);
    size = u16 order s (pos + 4);
    timestamp = f64 order s (pos + 6);
    src = u16 order s (pos + 14);
    src_ent = String.get_uint8 s (pos + 16);
    dst = u16 order s (pos + 17);
    dst_ent = String.get_uint8 s (pos + 19);
  }

(* How many of the bytes that the caller speaks of there are. *)
let extent ~pos ~len s =
  if pos < 0 || pos > String.length s then 0
  else
    let present = String.length s - pos in
    match len with None -> present | Some len -> max 0 (min len present)

let read ?(pos = 0) ?len s =
  let present = extent ~pos ~len s in
  if present < overhead then Error (Error.Too_short present)
  else
    let within h =
      if h.size + overhead <= present then Ok h
      else Error (Error.Truncated { stated = h.size + overhead; present })
    in
    match String.get_uint16_be s pos with
    | 0x54FE -> within (fields Little_endian s pos)
    | 0xFE54 -> within (fields Big_endian s pos)
    | sync -> Error (Error.Not_imc sync)

let check ?(pos = 0) h s =
  let present = extent ~pos ~len:None s in
  if h.size < 0 || h.size + overhead > present then
    Error (Error.Truncated { stated = h.size + overhead; present })
  else
    let stated = u16 h.order s (pos + size + h.size) in
    let computed = Crc.arc s ~pos ~len:(size + h.size) in
    if stated = computed then Ok () else Error (Error.Bad_checksum { stated; computed })

let pp ppf h =
  Fmt.pf ppf "message %d, %d bytes, from 0x%04x.%d to 0x%04x.%d at %.3f" h.id h.size h.src h.src_ent h.dst
    h.dst_ent h.timestamp
