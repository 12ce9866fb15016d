type content = Message of Message.t | Unknown of { id : int; payload : string }

type t = {
  order : Byte_order.t;
  timestamp : float;
  src : int;
  src_ent : int;
  dst : int;
  dst_ent : int;
  content : content;
}

let make ?(order = Byte_order.Little_endian) ?(src_ent = Header.any_entity) ?(dst = Header.nobody)
    ?(dst_ent = Header.any_entity) ~src ~timestamp m =
  { order; timestamp; src; src_ent; dst; dst_ent; content = Message m }

let id p = match p.content with Message m -> Message.id m | Unknown { id; _ } -> id

(* {1 Decoding} *)

let ( let* ) = Result.bind

let content (h : Header.t) s ~pos =
  let pos = pos + Header.size in
  if not (Message.is_known h.id) then Ok (Unknown { id = h.id; payload = String.sub s pos h.size })
  else
    let r = Reader.make h.order s ~pos ~len:h.size in
    match
      let m = Message.read r h.id in
      Reader.finish r;
      m
    with
    | m -> Ok (Message m)
    | exception Reader.Fault { at; fault } -> Error (Error.Bad_payload { id = h.id; at; fault })

let decode_after ?(pos = 0) (h : Header.t) s =
  let* () = Header.check ~pos h s in
  let* content = content h s ~pos in
  let { Header.order; timestamp; src; src_ent; dst; dst_ent; _ } = h in
  Ok { order; timestamp; src; src_ent; dst; dst_ent; content }

let decode ?(pos = 0) ?len s =
  let* h = Header.read ~pos ?len s in
  let present = min (String.length s - pos) (Option.value len ~default:max_int) in
  let surplus = present - Header.overhead - h.size in
  if surplus > 0 then Error (Error.Surplus surplus) else decode_after ~pos h s

(* {1 Encoding} *)

let write_header p ~size w =
  Writer.u16 w "sync" 0xFE54;
  Writer.u16 w "mgid" (id p);
  Writer.u16 w "size" size;
  Writer.f64 w p.timestamp;
  Writer.u16 w "src" p.src;
  Writer.u8 w "src_ent" p.src_ent;
  Writer.u16 w "dst" p.dst;
  Writer.u8 w "dst_ent" p.dst_ent

let payload p =
  let buffer = Buffer.create 128 in
  (match p.content with
   | Message m -> Message.write (Writer.make p.order buffer) m
   | Unknown { payload; _ } -> Buffer.add_string buffer payload);
  let size = Buffer.length buffer in
  if size > 0xFFFF then raise_notrace (Writer.Fault (Too_large { id = id p; size }));
  buffer

let encode p =
  try
    let payload = payload p in
    let size = Buffer.length payload in
    let packet = Buffer.create (size + Header.overhead) in
    let w = Writer.make p.order packet in
    write_header p ~size w;
    Buffer.add_buffer packet payload;
    Writer.u16 w "crc" (Crc.arc (Buffer.contents packet) ~pos:0 ~len:(Buffer.length packet));
    Ok (Buffer.contents packet)
  with Writer.Fault error -> Error error

(* {1 Showing} *)

let to_json p =
  let message =
    match p.content with
    | Message m -> Message.to_json m
    | Unknown { id; payload } -> `Assoc [ ("id", `Int id); ("payload", Json.raw payload) ]
  in
  `Assoc
    [
      ("timestamp", Json.float p.timestamp);
      ("src", `Int p.src);
      ("src_ent", `Int p.src_ent);
      ("dst", `Int p.dst);
      ("dst_ent", `Int p.dst_ent);
      ("message", message);
    ]

let pp ppf p = Yojson.Safe.pretty_print ppf (to_json p)
let equal p q = compare p q = 0
