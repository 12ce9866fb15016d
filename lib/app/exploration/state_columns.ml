type t = {
  mutable count : int;
  firsts : Buffer.t;  (* of digests: their first 8 bytes, and the others *)
  seconds : Buffer.t;
  parents : Buffer.t;
  lengths : Buffer.t;
  kinds : Buffer.t;
  texts : Buffer.t;
}

type state = { digest : string; parent : string; kind : int; text : string }

let create () =
  let buffer () = Buffer.create 256 in
  { count = 0; firsts = buffer (); seconds = buffer (); parents = buffer (); lengths = buffer (); kinds = buffer ();
    texts = buffer () }

let count c = c.count

let add c s =
  c.count <- c.count + 1;
  Buffer.add_substring c.firsts s.digest 0 8;
  Buffer.add_substring c.seconds s.digest 8 8;
  Buffer.add_string c.parents s.parent;
  Buffer.add_int32_le c.lengths (Int32.of_int (String.length s.text));
  Buffer.add_uint8 c.kinds s.kind;
  Buffer.add_string c.texts s.text

let states c =
  let lengths = Buffer.contents c.lengths in
  let rec from i at =
    if i = c.count then []
    else
      let length = Int32.to_int (String.get_int32_le lengths (4 * i)) and word column = Buffer.sub column (8 * i) 8 in
      let digest = word c.firsts ^ word c.seconds and kind = Char.code (Buffer.nth c.kinds i) in
      { digest; parent = word c.parents; kind; text = Buffer.sub c.texts at length } :: from (i + 1) (at + length)
  in
  from 0 0

let write out c =
  let columns = [ c.firsts; c.seconds; c.parents; c.lengths; c.kinds; c.texts ] in
  let head = Bytes.create 16 in
  let size = List.fold_left (fun size column -> size + Buffer.length column) 8 columns in
  Bytes.set_int64_le head 0 (Int64.of_int size);
  Bytes.set_int64_le head 8 (Int64.of_int c.count);
  output_bytes out head;
  List.iter (Buffer.output_buffer out) columns
