open Bigarray

type bytes_of_chunk = (char, int8_unsigned_elt, c_layout) Array1.t
type segment = (int32, int32_elt, c_layout) Array1.t

type t = {
  mutable chunks : bytes_of_chunk array;
  mutable widths : int array;  (* by chunk: bytes a number *)
  mutable bytes : int;  (* of all chunks *)
  mutable count : int;
  mutable table : segment array;  (* 0: free; else a tag above the bits of a place plus 1 *)
  mutable slots : int;
  mutable place_bits : int;
  mutable most : int;  (* numbers before the table has to grow *)
}

external get64 : bytes_of_chunk -> int -> int64 = "%caml_bigstring_get64u"
external set64 : bytes_of_chunk -> int -> int64 -> unit = "%caml_bigstring_set64u"

let chunk_bits = 16
let chunk_numbers = 1 lsl chunk_bits
let chunk_mask = chunk_numbers - 1

(* Numbers are read and written by eight bytes, from wherever they start. *)
let padding = 8
let bytes_of_chunk width = (chunk_numbers * width) + padding
let masks = Array.init 9 (fun width -> if width = 8 then -1 else (1 lsl (8 * width)) - 1)
let most_of slots = slots / 20 * 17

let bits_for n =
  let rec from bits = if 1 lsl bits > n then bits else from (bits + 1) in
  from 1

(* The table is in segments, none of which is ever given back: memory freed between long-lived blocks is seldom of
   use. *)
let segment_bits = 12
let segment_mask = (1 lsl segment_bits) - 1

let set_segments t n =
  let more = n - Array.length t.table in
  let segment _ = Array1.create int32 c_layout (1 lsl segment_bits) in
  t.table <- Array.append t.table (Array.init more segment);
  Array.iter (fun (segment : segment) -> Array1.fill segment 0l) t.table;
  t.slots <- n lsl segment_bits;
  t.most <- most_of t.slots;
  t.place_bits <- bits_for t.most

let create () =
  let t = { chunks = [||]; widths = [||]; bytes = 0; count = 0; table = [||]; slots = 0; place_bits = 1; most = 0 } in
  set_segments t 1;
  t

let count t = t.count

(* Places are below [count], and slots below [slots], from here on. *)

let get t i =
  let c = i lsr chunk_bits in
  let chunk = Array.unsafe_get t.chunks c and width = Array.unsafe_get t.widths c in
  Int64.to_int (get64 chunk ((i land chunk_mask) * width)) land Array.unsafe_get masks width

let set t i x =
  let c = i lsr chunk_bits in
  set64 (Array.unsafe_get t.chunks c) ((i land chunk_mask) * Array.unsafe_get t.widths c) (Int64.of_int x)

(* [set] where numbers follow. *)
let set_within t i x =
  let c = i lsr chunk_bits in
  let chunk = Array.unsafe_get t.chunks c and width = Array.unsafe_get t.widths c in
  for b = 0 to width - 1 do
    Array1.set chunk (((i land chunk_mask) * width) + b) (Char.unsafe_chr ((x asr (8 * b)) land 0xFF))
  done

(* {1 The table} *)

let hash x =
  let h = x * 0x1E37_79B9_7F4A_7C15 in
  let h = (h lxor (h lsr 32)) * 0x1F58_476D_1CE4_E5B9 in
  h lxor (h lsr 29)

(* 31 bits choose the slot, others are the tag. *)
let slot_of t h = ((h land 0x7FFF_FFFF) * t.slots) lsr 31
let tag_of t h = (h lsr 31) lsl t.place_bits land 0xFFFF_FFFF

let entry t slot =
  let segment : segment = Array.unsafe_get t.table (slot lsr segment_bits) in
  Int32.to_int (Array1.unsafe_get segment (slot land segment_mask)) land 0xFFFF_FFFF

let place_of t entry = (entry land ((1 lsl t.place_bits) - 1)) - 1
let tag_in t entry = (entry lsr t.place_bits) lsl t.place_bits
let next t slot = if slot + 1 = t.slots then 0 else slot + 1

(* The slot of [x], or the free one where it belongs. *)
let rec probe t x tag slot =
  let entry = entry t slot in
  if entry = 0 || (tag_in t entry = tag && get t (place_of t entry) = x) then slot else probe t x tag (next t slot)

let rec free t slot = if entry t slot = 0 then slot else free t (next t slot)

let occupy t slot tag i =
  let segment : segment = Array.unsafe_get t.table (slot lsr segment_bits) in
  Array1.unsafe_set segment (slot land segment_mask) (Int32.of_int (tag lor (i + 1)))

let fill t =
  for i = 0 to t.count - 1 do
    let h = hash (get t i) in
    occupy t (free t (slot_of t h)) (tag_of t h) i
  done

(* By small steps: a table is never much larger than it must be. *)
let grow t =
  let n = Array.length t.table in
  set_segments t (n + max 1 (n / 4));
  fill t

(* {1 Adding} *)

let last t = Array.length t.chunks - 1

let put_chunk t c width =
  let chunk : bytes_of_chunk = Array1.create char c_layout (bytes_of_chunk width) in
  if c > last t then begin
    let chunks = Array.append t.chunks [| chunk |] and widths = Array.append t.widths [| width |] in
    t.chunks <- chunks;
    t.widths <- widths
  end
  else begin
    for i = c * chunk_numbers to min t.count ((c + 1) * chunk_numbers) - 1 do
      set64 chunk ((i land chunk_mask) * width) (Int64.of_int (get t i))
    done;
    t.chunks.(c) <- chunk;
    t.bytes <- t.bytes - bytes_of_chunk t.widths.(c);
    t.widths.(c) <- width
  end;
  t.bytes <- t.bytes + bytes_of_chunk width

(* Chunk [c] has room for numbers as large as [x]. *)
let rec fit t c x =
  if x land masks.(t.widths.(c)) <> x then begin
    put_chunk t c (t.widths.(c) + 1);
    fit t c x
  end

let append t x =
  let c = t.count lsr chunk_bits in
  if c > last t then put_chunk t c (if c = 0 then 1 else t.widths.(c - 1));
  fit t c x;
  set t t.count x;
  t.count <- t.count + 1

let add t x =
  let h = hash x in
  let tag = tag_of t h in
  let slot = probe t x tag (slot_of t h) in
  let entry = entry t slot in
  if entry <> 0 then place_of t entry
  else begin
    let i = t.count in
    append t x;
    occupy t slot tag i;
    if t.count > t.most then grow t;
    -1 - i
  end

let find t x =
  let h = hash x in
  place_of t (entry t (probe t x (tag_of t h) (slot_of t h)))

let bytes t = t.bytes + (4 * t.slots)

let bytes_to_grow ~by t =
  let table = if t.count + by > t.most then t.slots else 0 in
  let chunks = ((t.count + by) lsr chunk_bits) + 1 - Array.length t.chunks in
  let width = if t.widths = [||] then 1 else t.widths.(last t) in
  table + (max 0 chunks * bytes_of_chunk width)

let renew t f =
  for i = 0 to t.count - 1 do
    let x = f (get t i) in
    fit t (i lsr chunk_bits) x;
    set_within t i x
  done;
  set_segments t (Array.length t.table);
  fill t

(* {1 Reading ahead} *)

let read_table t x = entry t (slot_of t (hash x))

let read_number t x =
  let i = place_of t (entry t (slot_of t (hash x))) in
  if i >= 0 then get t i else 0
