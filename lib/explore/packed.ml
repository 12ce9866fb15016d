open Bigarray

type words_of_chunk = (int, int_elt, c_layout) Array1.t
type parents_of_chunk = (int32, int32_elt, c_layout) Array1.t

type t = {
  words : int;
  mutable chunks : words_of_chunk array;
  mutable parents : parents_of_chunk array;
  mutable count : int;
  mutable table : words_of_chunk;  (* 0: free; else a tag above 32 bits of a state's number plus 1 *)
  mutable mask : int;
  mutable most : int;  (* states before the table has to grow *)
}

let chunk_bits = 16
let chunk_states = 1 lsl chunk_bits
let chunk_mask = chunk_states - 1
let number_mask = 0xFFFF_FFFF
let most_of slots = slots / 10 * 7

let fresh_table slots =
  let table = Array1.create int c_layout slots in
  Array1.fill table 0;
  table

let create ~words =
  let slots = 4096 in
  { words; chunks = [||]; parents = [||]; count = 0; table = fresh_table slots; mask = slots - 1; most = most_of slots }

let words t = t.words
let count t = t.count

(* Arrays are indexed without checks from here on: numbers of states are below [count], slots within [mask], and keys
   have [words] words. *)

let chunk t i : words_of_chunk = Array.unsafe_get t.chunks (i lsr chunk_bits)
let word (chunk : words_of_chunk) i = Array1.unsafe_get chunk i

let parent t i =
  let parents : parents_of_chunk = t.parents.(i lsr chunk_bits) in
  Int32.to_int parents.{i land chunk_mask}

let load t i key =
  let chunk = chunk t i and base = (i land chunk_mask) * t.words in
  for w = 0 to t.words - 1 do
    Array.unsafe_set key w (word chunk (base + w))
  done

(* The low bits choose the slot, the high ones are the tag. *)
let mix h k =
  let h = (h lxor k) * 0x1E37_79B9_7F4A_7C15 in
  h lxor (h lsr 32)

let hash t (key : int array) =
  let h = ref (mix 0 (Array.unsafe_get key 0)) in
  for w = 1 to t.words - 1 do
    h := mix !h (Array.unsafe_get key w)
  done;
  !h

let tag_of h = (h lsr 1) land lnot number_mask

let rec same (chunk : words_of_chunk) base (key : int array) w =
  w < 0 || (word chunk (base + w) = Array.unsafe_get key w && same chunk base key (w - 1))

(* The slot of [key], or the free one where it belongs. *)
let rec probe t (table : words_of_chunk) key tag slot =
  let entry = Array1.unsafe_get table slot in
  if entry = 0 then slot
  else if entry land lnot number_mask = tag then begin
    let i = (entry land number_mask) - 1 in
    if same (chunk t i) ((i land chunk_mask) * t.words) key (t.words - 1) then slot
    else probe t table key tag ((slot + 1) land t.mask)
  end
  else probe t table key tag ((slot + 1) land t.mask)

let rec free (table : words_of_chunk) mask slot =
  if Array1.unsafe_get table slot = 0 then slot else free table mask ((slot + 1) land mask)

let fill t =
  let key = Array.make t.words 0 in
  for i = 0 to t.count - 1 do
    load t i key;
    let h = hash t key in
    Array1.unsafe_set t.table (free t.table t.mask (h land t.mask)) (tag_of h lor (i + 1))
  done

let large = 1 lsl 20

(* The old table is given back before there is a new one: the states can fill it again. *)
let resize t slots =
  t.table <- fresh_table 1;
  if slots > large then Gc.full_major ();
  t.table <- fresh_table slots;
  t.mask <- slots - 1;
  t.most <- most_of slots;
  fill t

let append t key ~parent =
  let i = t.count in
  let within = i land chunk_mask in
  if within = 0 then begin
    t.chunks <- Array.append t.chunks [| Array1.create int c_layout (chunk_states * t.words) |];
    t.parents <- Array.append t.parents [| Array1.create int32 c_layout chunk_states |]
  end;
  let chunk = chunk t i and parents : parents_of_chunk = Array.unsafe_get t.parents (i lsr chunk_bits) in
  let base = within * t.words in
  for w = 0 to t.words - 1 do
    Array1.unsafe_set chunk (base + w) (Array.unsafe_get key w)
  done;
  Array1.unsafe_set parents within (Int32.of_int parent);
  t.count <- i + 1

let add t key ~parent =
  let h = hash t key in
  let tag = tag_of h in
  let slot = probe t t.table key tag (h land t.mask) in
  let entry = Array1.unsafe_get t.table slot in
  if entry <> 0 then (entry land number_mask) - 1
  else begin
    let i = t.count in
    append t key ~parent;
    Array1.unsafe_set t.table slot (tag lor (i + 1));
    if t.count > t.most then resize t (2 * (t.mask + 1));
    -1 - i
  end

let find t key =
  let h = hash t key in
  let slot = probe t t.table key (tag_of h) (h land t.mask) in
  (t.table.{slot} land number_mask) - 1

let bytes_of_chunk t = chunk_states * ((8 * t.words) + 4)
let bytes t = (Array.length t.chunks * bytes_of_chunk t) + (8 * (t.mask + 1))

let bytes_to_grow t =
  let table = if t.count >= t.most then 8 * (t.mask + 1) else 0 in
  let chunk = if t.count land chunk_mask = 0 then bytes_of_chunk t else 0 in
  table + chunk

let rewrite t ~words f =
  let old = Array.make t.words 0 and fresh = Array.make words 0 in
  let renewed c (chunk : words_of_chunk) =
    let renewed = if words = t.words then chunk else Array1.create int c_layout (chunk_states * words) in
    for i = 0 to min chunk_states (t.count - (c * chunk_states)) - 1 do
      for w = 0 to t.words - 1 do
        old.(w) <- chunk.{(i * t.words) + w}
      done;
      Array.fill fresh 0 words 0;
      f old fresh;
      for w = 0 to words - 1 do
        renewed.{(i * words) + w} <- fresh.(w)
      done
    done;
    t.chunks.(c) <- renewed
  in
  Array.iteri renewed t.chunks;
  let t = { t with words } in
  Array1.fill t.table 0;
  fill t;
  t
