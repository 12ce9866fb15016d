let wrong why = Drawn.wrong "" "%s" why
let broken () = wrong "this ZIP archive is broken"

let short text i = if i < 0 || i + 2 > String.length text then broken () else String.get_uint16_le text i
let long text i = short text i + (short text (i + 2) lsl 16)

let part text start length =
  if start < 0 || length < 0 || start + length > String.length text then broken () else String.sub text start length

(* The record at the end says where the list of files is. A comment of at most 65,535 bytes may follow it. *)
let end_record text =
  let rec find i =
    if i < 0 || i < String.length text - 65_557 then wrong "this is no ZIP archive"
    else if long text i = 0x06054b50 then i
    else find (i - 1)
  in
  find (String.length text - 22)

type entry = { name : string; flags : int; how : int; packed : int; at : int }

let entries text =
  let record = end_record text in
  let rec go n at found =
    if n = 0 then List.rev found
    else if long text at <> 0x02014b50 then broken ()
    else
      let name_length = short text (at + 28) in
      let entry =
        { name = part text (at + 46) name_length; flags = short text (at + 8); how = short text (at + 10);
          packed = long text (at + 20); at = long text (at + 42) }
      in
      go (n - 1) (at + 46 + name_length + short text (at + 30) + short text (at + 32)) (entry :: found)
  in
  go (short text (record + 10)) (long text (record + 16)) []

let inflated ~most ~too_long packed =
  let buffer = Buffer.create (4 * String.length packed) and read = ref 0 in
  let refill bytes =
    let n = min (Bytes.length bytes) (String.length packed - !read) in
    Bytes.blit_string packed !read bytes 0 n;
    read := !read + n;
    n
  in
  let flush bytes n =
    if Buffer.length buffer + n > most then too_long ();
    Buffer.add_subbytes buffer bytes 0 n
  in
  (try Zlib.uncompress ~header:false refill flush with Zlib.Error _ -> broken ());
  Buffer.contents buffer

let unpacked ~whole ~most text entry =
  let too_long () = wrong (Printf.sprintf "unpacked, it has more than %d MB" (whole / 1_000_000)) in
  if entry.flags land 1 <> 0 then wrong (Printf.sprintf "'%s' in it is encrypted" entry.name);
  if long text entry.at <> 0x04034b50 then broken ();
  let start = entry.at + 30 + short text (entry.at + 26) + short text (entry.at + 28) in
  let packed = part text start entry.packed in
  match entry.how with
  | 0 -> if String.length packed > most then too_long () else packed
  | 8 -> inflated ~most ~too_long packed
  | _ -> wrong (Printf.sprintf "'%s' in it is packed in a way that is not known here" entry.name)

(* Files that share their bytes would be read again and again. *)
let check_apart text entries =
  let packed = List.fold_left (fun n e -> n + e.packed) 0 entries in
  if packed > String.length text then wrong "the files in this archive overlap"

let files ~most wanted text =
  let entries = List.filter (fun e -> wanted e.name) (entries text) in
  check_apart text entries;
  let add (found, left) entry =
    let contents = unpacked ~whole:most ~most:left text entry in
    ((entry.name, contents) :: found, left - String.length contents)
  in
  List.rev (fst (List.fold_left add ([], most) entries))
