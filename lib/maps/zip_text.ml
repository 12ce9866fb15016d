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

let long_long text i =
  let high = long text (i + 4) in
  if high >= 1 lsl 30 then broken () else long text i + (high lsl 32)

type entry = { name : string; flags : int; how : int; check : int; packed : int; size : int; at : int }

(* Numbers of ZIP64 stand elsewhere, and these in their places. *)
let no_short = 0xFFFF
let no_long = 0xFFFF_FFFF

(* How many files there are, and where their list begins. *)
let directory text =
  let record = end_record text in
  let count = short text (record + 10) and at = long text (record + 16) in
  if count <> no_short && at <> no_long then (count, at)
  else if record < 20 || long text (record - 20) <> 0x07064b50 then (count, at)
  else
    let record = long_long text (record - 12) in
    if long text record <> 0x06064b50 then broken () else (long_long text (record + 32), long_long text (record + 48))

(* The extra field 1 has those of the size, the packed size and the place that do not stand in the list. *)
let in_full text entry ~from ~until =
  let rec find at =
    if at + 4 > until then []
    else
      let length = short text (at + 2) in
      if short text at = 1 then List.init (length / 8) (fun i -> long_long text (at + 4 + (8 * i)))
      else find (at + 4 + length)
  in
  let full (number, rest) =
    if number <> no_long then (number, rest) else match rest with n :: rest -> (n, rest) | [] -> broken () in
  if entry.size <> no_long && entry.packed <> no_long && entry.at <> no_long then entry
  else
    let size, rest = full (entry.size, find from) in
    let packed, rest = full (entry.packed, rest) in
    let at, _ = full (entry.at, rest) in
    { entry with size; packed; at }

let is_entry text at = at + 4 <= String.length text && long text at = 0x02014b50

let entries text =
  let count, first = directory text in
  let rec go n at found =
    if n = 0 then if is_entry text at then broken () else List.rev found
    else if not (is_entry text at) then broken ()
    else
      let from = at + 46 + short text (at + 28) in
      let until = from + short text (at + 30) in
      let entry =
        { name = part text (at + 46) (from - at - 46); flags = short text (at + 8); how = short text (at + 10);
          check = long text (at + 16); packed = long text (at + 20); size = long text (at + 24);
          at = long text (at + 42) }
      in
      go (n - 1) (until + short text (at + 32)) (in_full text entry ~from ~until :: found)
  in
  go count first []

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

(* Which of two files of one name is meant is not known. *)
let check_names entries =
  let seen = Hashtbl.create 16 in
  let add entry =
    if Hashtbl.mem seen entry.name then wrong (Printf.sprintf "this archive has two files '%s'" entry.name);
    Hashtbl.replace seen entry.name ()
  in
  List.iter add entries

let files ~most wanted text =
  let entries = List.filter (fun e -> wanted e.name && not (is_resource_fork e.name)) (entries text) in
  check_apart text entries;
  check_names entries;
  let add (found, left) entry =
    let contents = unpacked ~all:most ~most:left text entry in
    ((entry.name, contents) :: found, left - String.length contents)
  in
  List.rev (fst (List.fold_left add ([], most) entries))
