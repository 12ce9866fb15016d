let little_endian n =
  let bytes = Bytes.create 4 in
  Bytes.set_int32_le bytes 0 n;
  Bytes.to_string bytes

(* Deflate, no flags, no date, no name, an unknown system. *)
let header = "\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\xff"

let gzip text =
  let buffer = Buffer.create (String.length text / 3) and read = ref 0 in
  let refill bytes =
    let n = min (Bytes.length bytes) (String.length text - !read) in
    Bytes.blit_string text !read bytes 0 n;
    read := !read + n;
    n
  in
  Buffer.add_string buffer header;
  Zlib.compress ~level:9 ~header:false refill (fun bytes n -> Buffer.add_subbytes buffer bytes 0 n);
  Buffer.add_string buffer (little_endian (Zlib.update_crc_string 0l text 0 (String.length text)));
  Buffer.add_string buffer (little_endian (Int32.of_int (String.length text)));
  Buffer.contents buffer
