let wrong why = Drawn.wrong "" "%s" why
let broken () = wrong "this ZIP archive is broken"

let short text i = if i < 0 || i + 2 > String.length text then broken () else String.get_uint16_le text i
let long text i = short text i + (short text (i + 2) lsl 16)

let part text start length =
  if start < 0 || length < 0 || start + length > String.length text then broken () else String.sub text start length

(* The record at the end has the place of the list of files. A comment of at most 65,535 bytes may follow it. *)
let end_record text =
  let rec find i =
    if i < 0 || i < String.length text - 65_557 then wrong "this is not a ZIP archive"
    else if long text i = 0x06054b50 then i
    else find (i - 1)
  in
  find (String.length text - 22)

type entry = { name : string; flags : int; how : int; check : int; packed : int; size : int; at : int }

let entries text =
  let record = end_record text in
  let rec go n at found =
    if n = 0 then List.rev found
    else if long text at <> 0x02014b50 then broken ()
    else
      let name_length = short text (at + 28) in
      let entry =
        { name = part text (at + 46) name_length; flags = short text (at + 8); how = short text (at + 10);
          check = long text (at + 16); packed = long text (at + 20); size = long text (at + 24);
          at = long text (at + 42) }
      in
      go (n - 1) (at + 46 + name_length + short text (at + 30) + short text (at + 32)) (entry :: found)
  in
  go (short text (record + 10)) (long text (record + 16)) []

(* {!Zlib.uncompress} never returns if the stream is cut short. *)
let inflated ~most ~too_long packed =
  let buffer = Buffer.create (4 * String.length packed) and out = Bytes.create 65_536 in
  (* Behind a stream without a header the library wants another byte. *)
  let input = Bytes.of_string (packed ^ "\000") in
  let stream = Zlib.inflate_init false in
  let rec go at =
    let left = Bytes.length input - at in
    let finished, used, made = Zlib.inflate stream input at left out 0 (Bytes.length out) Zlib.Z_SYNC_FLUSH in
    if Buffer.length buffer + made > most then too_long ();
    Buffer.add_subbytes buffer out 0 made;
    if not finished then if used = 0 && made = 0 then broken () else go (at + used)
  in
  let finally () = Zlib.inflate_end stream in
  (try Fun.protect ~finally (fun () -> go 0) with Zlib.Error _ -> broken ());
  Buffer.contents buffer

let checksum text = Int32.to_int (Zlib.update_crc_string 0l text 0 (String.length text)) land 0xFFFF_FFFF

let whole entry contents =
  if String.length contents <> entry.size || checksum contents <> entry.check then
    wrong (Printf.sprintf "'%s' in this archive is damaged: its checksum is another" entry.name);
  contents

let unpacked ~all ~most text entry =
  let too_long () = wrong (Printf.sprintf "unpacked, it has more than %d MB" (all / 1_000_000)) in
  if entry.flags land 1 <> 0 then wrong (Printf.sprintf "'%s' in it is encrypted" entry.name);
  if long text entry.at <> 0x04034b50 then broken ();
  let start = entry.at + 30 + short text (entry.at + 26) + short text (entry.at + 28) in
  let packed = part text start entry.packed in
  match entry.how with
  | 0 -> if String.length packed > most then too_long () else whole entry packed
  | 8 -> whole entry (inflated ~most ~too_long packed)
  | _ -> wrong (Printf.sprintf "'%s' in it is packed in a way that is not known here" entry.name)

(* macOS adds such files beside others, with the same ends of names. *)
let is_resource_fork name =
  String.starts_with ~prefix:"__MACOSX/" name || String.starts_with ~prefix:"._" (Filename.basename name)

(* Files that share their bytes would be read again and again. *)
let check_apart text entries =
  let packed = List.fold_left (fun n e -> n + e.packed) 0 entries in
  if packed > String.length text then wrong "the files in this archive overlap"

let files ~most wanted text =
  let entries = List.filter (fun e -> wanted e.name && not (is_resource_fork e.name)) (entries text) in
  check_apart text entries;
  let add (found, left) entry =
    let contents = unpacked ~all:most ~most:left text entry in
    ((entry.name, contents) :: found, left - String.length contents)
  in
  List.rev (fst (List.fold_left add ([], most) entries))
