open Bigarray

type words_of_chunk = Slot.table

type t = {
  words : int;
  mutable chunks : words_of_chunk array;
  mutable parents : Parents.t;
  mutable count : int;
  mutable bare : bool;  (* whether the table has states, which are of one word, and not their numbers *)
  mutable table : Slot.table;
  mutable mask : int;
  mutable most : int;  (* states before the table has to grow *)
  waiting : Pending.t;
}

let chunk_bits = 16
let chunk_states = 1 lsl chunk_bits
let chunk_mask = chunk_states - 1

let fresh_table slots =
  let table = Array1.create int c_layout slots in
  Array1.fill table 0;
  table

let create ~words =
  let slots = 4096 in
  let table = fresh_table slots and waiting = Pending.create ~words in
  let parents = Parents.create () in
  { words; chunks = [||]; parents; count = 0; bare = words = 1; table; mask = slots - 1; most = Slot.most slots;
    waiting }

let words t = t.words
let count t = t.count

(* Arrays are indexed without checks from here on: numbers of states are below [count], slots within [mask], and keys
   have [words] words. *)

let chunk t i : words_of_chunk = Array.unsafe_get t.chunks (i lsr chunk_bits)
let word (chunk : words_of_chunk) i = Array1.unsafe_get chunk i

let parent t i = Parents.get t.parents i

let load t i key =
  let chunk = chunk t i and base = (i land chunk_mask) * t.words in
  for w = 0 to t.words - 1 do
    Array.unsafe_set key w (word chunk (base + w))
  done

let rec same (chunk : words_of_chunk) base (keys : int array) at w =
  w < 0 || (word chunk (base + w) = Array.unsafe_get keys (at + w) && same chunk base keys at (w - 1))

(* The slot of the key that [keys] has from [at] on, or the free one where it belongs. *)
let rec probe t (table : Slot.table) keys at tag slot =
  let entry = Array1.unsafe_get table slot in
  if entry = 0 then slot
  else if entry land lnot Slot.number_mask = tag then begin
    let i = (entry land Slot.number_mask) - 1 in
    if same (chunk t i) ((i land chunk_mask) * t.words) keys at (t.words - 1) then slot
    else probe t table keys at tag ((slot + 1) land t.mask)
  end
  else probe t table keys at tag ((slot + 1) land t.mask)

let rec free (table : Slot.table) mask slot =
  if Array1.unsafe_get table slot = 0 then slot else free table mask ((slot + 1) land mask)

let fill t =
  let key = Array.make t.words 0 in
  for i = 0 to t.count - 1 do
    load t i key;
    let h = Slot.hash ~words:t.words key in
    let entry = if t.bare then key.(0) + 1 else Slot.entry h i in
    Array1.unsafe_set t.table (free t.table t.mask (h land t.mask)) entry
  done

(* From now on the table has numbers. *)
let number_all t =
  if t.bare then begin
    t.bare <- false;
    Array1.fill t.table 0;
    fill t
  end

let large = 1 lsl 17

let set_table t slots =
  t.table <- fresh_table slots;
  t.mask <- slots - 1;
  t.most <- Slot.most slots;
  fill t

(* The old table is given back before there is a new one: the states can fill it again. If memory does not suffice
   for the new one, it does for one like the old one. *)
let resize t slots =
  let before = t.mask + 1 in
  t.table <- fresh_table 1;
  t.mask <- 0;
  if slots > large then Gc.full_major ();
  try set_table t slots
  with Out_of_memory ->
    set_table t before;
    raise Out_of_memory

let append t keys at ~parent =
  let i = t.count in
  let within = i land chunk_mask in
  if within = 0 && i lsr chunk_bits = Array.length t.chunks then
    t.chunks <- Array.append t.chunks [| Array1.create int c_layout (chunk_states * t.words) |];
  let chunk = chunk t i and base = within * t.words in
  for w = 0 to t.words - 1 do
    Array1.unsafe_set chunk (base + w) (Array.unsafe_get keys (at + w))
  done;
  Parents.add t.parents parent;
  t.count <- i + 1

let add_at t keys at h ~parent =
  let tag = Slot.tag h in
  let slot = probe t t.table keys at tag (h land t.mask) in
  let entry = Array1.unsafe_get t.table slot in
  if entry <> 0 then (entry land Slot.number_mask) - 1
  else begin
    let i = t.count in
    append t keys at ~parent;
    Array1.unsafe_set t.table slot (tag lor (i + 1));
    if t.count > t.most then resize t (2 * (t.mask + 1));
    -1 - i
  end

let add_bare t keys at h ~parent ~fresh =
  let word = Array.unsafe_get keys at in
  let slot = Slot.find_bare t.table t.mask (word + 1) (h land t.mask) in
  if Array1.unsafe_get t.table slot = 0 then begin
    let i = t.count in
    append t keys at ~parent;
    Array1.unsafe_set t.table slot (word + 1);
    if t.count > t.most then resize t (2 * (t.mask + 1));
    fresh i word
  end

(* {1 Many at a time}

   A bare table has the states: there is only one read. *)

let read_states t =
  let waiting = t.waiting and table : Slot.table = t.table and mask = t.mask in
  let seen = ref 0 in
  for k = 0 to waiting.length - 1 do
    let i = (Array1.unsafe_get table (Array.unsafe_get waiting.hashes k land mask) land Slot.number_mask) - 1 in
    if i >= 0 then seen := !seen lxor word (chunk t i) ((i land chunk_mask) * t.words)
  done;
  ignore (Sys.opaque_identity !seen)

let flush t ~fresh =
  let waiting = t.waiting in
  Pending.read_slots waiting t.table t.mask;
  if not t.bare then read_states t;
  for k = 0 to waiting.length - 1 do
    let at = k * t.words in
    let parent = Array.unsafe_get waiting.parents k and h = Array.unsafe_get waiting.hashes k in
    if t.bare then add_bare t waiting.keys at h ~parent ~fresh
    else begin
      let i = add_at t waiting.keys at h ~parent in
      if i < 0 then fresh (-1 - i) (Array.unsafe_get waiting.keys at)
    end
  done;
  Pending.clear waiting

let push t key ~parent ~fresh = if Pending.add t.waiting key ~parent then flush t ~fresh

let find t key =
  number_all t;
  let h = Slot.hash ~words:t.words key in
  Slot.number t.table.{probe t t.table key 0 (Slot.tag h) (h land t.mask)}

(* {1 Others' states} *)

let parents t = t.parents
let room t = max 1 (min t.most (Array.length t.chunks * chunk_states) - (2 * Pending.most))
let table t = t.table

let clear t =
  t.count <- 0;
  t.bare <- false;
  t.parents <- Parents.create ();
  Pending.clear t.waiting;
  Array1.fill t.table 0

(* The places of waiting states hold others' states meanwhile. *)
let members t source ~first ~n f =
  number_all t;
  let waiting = t.waiting and key = Array.make t.words 0 in
  for k = 0 to n - 1 do
    for w = 0 to t.words - 1 do
      key.(w) <- Int64.to_int (Bytes.get_int64_le source (8 * (((first + k) * t.words) + w)))
    done;
    ignore (Pending.add waiting key ~parent:0 : bool)
  done;
  Pending.read_slots waiting t.table t.mask;
  read_states t;
  for k = 0 to n - 1 do
    let h = waiting.hashes.(k) in
    let entry = t.table.{probe t t.table waiting.keys (k * t.words) (Slot.tag h) (h land t.mask)} in
    if entry <> 0 then f (Slot.number entry)
  done;
  Pending.clear waiting

let bytes_of_chunk t = chunk_states * 8 * t.words
let bytes t = (Array.length t.chunks * bytes_of_chunk t) + (8 * (t.mask + 1)) + Parents.bytes t.parents

let bytes_to_grow t ~by =
  let table = if t.count + by > t.most then 8 * (t.mask + 1) else 0 in
  let chunks = ((t.count + by) lsr chunk_bits) + 1 - Array.length t.chunks in
  table + (max 0 chunks * bytes_of_chunk t)

let bytes_to_rewrite t ~words = if words = t.words then 0 else Array.length t.chunks * chunk_states * 8 * words
let forget_waiting t = Pending.clear t.waiting

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
  let t = { t with words; waiting = Pending.create ~words; bare = t.bare && words = 1 } in
  Array1.fill t.table 0;
  fill t;
  t
