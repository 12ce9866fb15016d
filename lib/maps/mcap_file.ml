type schema = { name : string; json_schema : Yojson.Safe.t }
type channel = { topic : string; schema : schema }
type message = { channel : channel; time : float; content : Yojson.Safe.t }

(* Journals have milliseconds; a float of today's time has no more than a quarter of a microsecond. *)
let nanoseconds time =
  let microseconds = Float.to_int (Float.round (Float.max 0. time *. 1e6)) in
  (microseconds / 1_000_000, microseconds mod 1_000_000 * 1000)

(* Whole nanoseconds of an [int] end in 2116. *)
let last_year = 2115

let stamp time = let seconds, rest = nanoseconds time in (seconds * 1_000_000_000) + rest

(* {1 Parts of records: little-endian} *)

let u8 = Buffer.add_uint8
let u16 = Buffer.add_uint16_le
let u32 b n = Buffer.add_int32_le b (Int32.of_int n)
let u64 b n = Buffer.add_int64_le b (Int64.of_int n)

let written write =
  let b = Buffer.create 256 in
  write b;
  Buffer.contents b

let text b s = u32 b (String.length s); Buffer.add_string b s

(* Its length comes first: of an array, a map, or the bytes of a schema. *)
let sized b write = text b (written write)

let record b opcode write =
  let content = written write in
  u8 b opcode;
  u64 b (String.length content);
  Buffer.add_string b content

let checksum s = Int32.to_int (Zlib.update_crc_string 0l s 0 (String.length s)) land 0xFFFF_FFFF

(* {1 Channels and schemas, by number} *)

type numbered = { schemas : (int * schema) list; channels : (int * channel) list }

(* The first of each name. *)
let distinct name_of xs =
  let known = Hashtbl.create 64 in
  let is_new x = not (Hashtbl.mem known (name_of x)) && (Hashtbl.add known (name_of x) (); true) in
  List.filter is_new xs

let numbered messages =
  let count xs = List.mapi (fun i x -> (i + 1, x)) xs in
  let channels = distinct (fun c -> c.topic) (List.rev (List.rev_map (fun m -> m.channel) messages)) in
  { schemas = count (distinct (fun s -> s.name) (List.map (fun (c : channel) -> c.schema) channels));
    channels = count channels }

let schema_number all name = fst (List.find (fun (_, s) -> String.equal s.name name) all.schemas)

let put_schemas all b =
  let schema (number, { name; json_schema }) =
    record b 0x03 (fun b ->
        u16 b number;
        text b name;
        text b "jsonschema";
        text b (Dolphin_json_text.Canonical.to_string json_schema))
  in
  List.iter schema all.schemas

let put_channels all b =
  let channel (number, { topic; schema }) =
    record b 0x04 (fun b ->
        u16 b number;
        u16 b (schema_number all schema.name);
        text b topic;
        text b "json";
        sized b ignore)
  in
  List.iter channel all.channels

(* {1 Chunks} *)

(* A message with its channel's number, its number there, and its time in nanoseconds. *)
type item = { number : int; ordinal : int; at : int; json : string }

(* The known data of a chunk in the file: its place, its length, and the places of its channels' indices. *)
type chunk = {
  first : int;
  last : int;
  start : int;
  length : int;
  indices : (int * int) list;
  indexed : int;
  size : int;
}

let most_bytes = 1_000_000

(* In pieces of some 1 MB. *)
let pieces items =
  let add (whole, piece, bytes) item =
    let bytes' = bytes + String.length item.json in
    if piece <> [] && bytes' > most_bytes then (List.rev piece :: whole, [ item ], String.length item.json)
    else (whole, item :: piece, bytes')
  in
  let whole, piece, _ = List.fold_left add ([], [], 0) items in
  List.rev (if piece = [] then whole else List.rev piece :: whole)

let put_message b { number; ordinal; at; json } =
  record b 0x05 (fun b ->
      u16 b number;
      u32 b ordinal;
      u64 b at;
      u64 b at;
      Buffer.add_string b json)

(* The places of each channel's messages in the chunk. *)
let records_of all items =
  let b = Buffer.create most_bytes in
  put_schemas all b;
  put_channels all b;
  let places = Hashtbl.create 64 in
  let put item =
    let before = Option.value (Hashtbl.find_opt places item.number) ~default:[] in
    Hashtbl.replace places item.number ((item.at, Buffer.length b) :: before);
    put_message b item
  in
  List.iter put items;
  let by_number = Hashtbl.fold (fun number found all -> (number, List.rev found) :: all) places [] in
  (Buffer.contents b, List.sort Stdlib.compare by_number)

let put_index b (number, places) =
  let at = Buffer.length b in
  record b 0x07 (fun b ->
      u16 b number;
      sized b (fun b -> List.iter (fun (time, place) -> u64 b time; u64 b place) places));
  (number, at)

let put_chunk b all items =
  let records, places = records_of all items in
  let times = List.map (fun item -> item.at) items in
  let first = List.fold_left min max_int times and last = List.fold_left max 0 times in
  let start = Buffer.length b and size = String.length records in
  record b 0x06 (fun b ->
      u64 b first;
      u64 b last;
      u64 b size;
      u32 b (checksum records);
      text b "";
      u64 b size;
      Buffer.add_string b records);
  let length = Buffer.length b - start in
  let indices = List.map (put_index b) places in
  { first; last; start; length; indices; indexed = Buffer.length b - start - length; size }

let put_chunk_index b c =
  record b 0x08 (fun b ->
      u64 b c.first;
      u64 b c.last;
      u64 b c.start;
      u64 b c.length;
      sized b (fun b -> List.iter (fun (number, at) -> u16 b number; u64 b at) c.indices);
      u64 b c.indexed;
      text b "";
      u64 b c.size;
      u64 b c.size)

(* {1 The file} *)

let put_statistics b all chunks items =
  let counts = Hashtbl.create 64 in
  let count item =
    Hashtbl.replace counts item.number (1 + Option.value (Hashtbl.find_opt counts item.number) ~default:0) in
  List.iter count items;
  record b 0x0B (fun b ->
      u64 b (List.length items);
      u16 b (List.length all.schemas);
      u32 b (List.length all.channels);
      u32 b 0;
      u32 b 0;
      u32 b (List.length chunks);
      u64 b (List.fold_left (fun least c -> min least c.first) (if chunks = [] then 0 else max_int) chunks);
      u64 b (List.fold_left (fun most c -> max most c.last) 0 chunks);
      sized b (fun b -> List.iter (fun (number, _) -> u16 b number; u64 b (Hashtbl.find counts number)) all.channels))

(* The groups of the summary, each of one kind of record. *)
let put_groups b groups =
  let put (opcode, write) =
    let start = Buffer.length b in
    write b;
    (opcode, start, Buffer.length b - start)
  in
  List.filter (fun (_, _, length) -> length > 0) (List.map put groups)

let put_offset b (opcode, start, length) =
  record b 0x0E (fun b ->
      u8 b opcode;
      u64 b start;
      u64 b length)

let magic = "\x89MCAP0\r\n"

let items all messages =
  let numbers = Hashtbl.create 64 and ordinals = Hashtbl.create 64 in
  List.iter (fun (number, c) -> Hashtbl.add numbers c.topic number) all.channels;
  let item { channel; time; content } =
    let number = Hashtbl.find numbers channel.topic in
    let ordinal = Option.value (Hashtbl.find_opt ordinals number) ~default:0 in
    Hashtbl.replace ordinals number (ordinal + 1);
    { number; ordinal; at = stamp time; json = Dolphin_json_text.Canonical.to_string content }
  in
  List.rev (List.rev_map item messages)

let put_footer b start offsets =
  let fields = written (fun b -> u64 b start; u64 b offsets) in
  let so_far = Buffer.sub b start (Buffer.length b - start) in
  let head = written (fun b -> u8 b 0x02; u64 b 20) in
  Buffer.add_string b (head ^ fields);
  u32 b (checksum (so_far ^ head ^ fields))

let to_string messages =
  let messages = List.stable_sort (fun a b -> Float.compare a.time b.time) messages in
  let all = numbered messages in
  let items = items all messages in
  let b = Buffer.create 1_000_000 in
  Buffer.add_string b magic;
  record b 0x01 (fun b -> text b ""; text b "dolphin");
  let chunks = List.map (put_chunk b all) (pieces items) in
  record b 0x0F (fun b -> u32 b 0);
  let start = Buffer.length b in
  let groups =
    put_groups b
      [ (0x03, put_schemas all); (0x04, put_channels all);
        (0x08, fun b -> List.iter (put_chunk_index b) chunks);
        (0x0B, fun b -> put_statistics b all chunks items) ] in
  let offsets = Buffer.length b in
  List.iter (put_offset b) groups;
  put_footer b start offsets;
  Buffer.add_string b magic;
  Buffer.contents b
