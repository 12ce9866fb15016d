open Bigarray

type words_of_chunk = (int, int_elt, c_layout) Array1.t

type t = {
  words : int;
  mutable chunks : words_of_chunk array;
  mutable parents : Parents.t;
  mutable count : int;
  mutable bare : bool;  (* whether the table has states, which are of one word, and not their numbers *)
  mutable table : words_of_chunk;
  (* 0: free; else if it is bare, the state plus 1; otherwise a tag above 32 bits of a state's number plus 1 *)
  mutable mask : int;
  mutable most : int;  (* states before the table has to grow *)
  waiting : waiting;
}

(* States to be added, by their order. *)
and waiting = {
  keys : int array;
  hashes : int array;
  from : int array;  (* parents *)
  mutable length : int;
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

(* As many as there are lines in the first caches, about. *)
let most_waiting = 192

let nothing_waits words =
  let array n = Array.make n 0 in
  { keys = array (most_waiting * words); hashes = array most_waiting; from = array most_waiting; length = 0 }

let create ~words =
  let slots = 4096 in
  let table = fresh_table slots and waiting = nothing_waits words in
  let parents = Parents.create () in
  { words; chunks = [||]; parents; count = 0; bare = words = 1; table; mask = slots - 1; most = most_of slots; waiting }

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

let rec same (chunk : words_of_chunk) base (keys : int array) at w =
  w < 0 || (word chunk (base + w) = Array.unsafe_get keys (at + w) && same chunk base keys at (w - 1))

(* The slot of the key that [keys] has from [at] on, or the free one where it belongs. *)
let rec probe t (table : words_of_chunk) keys at tag slot =
  let entry = Array1.unsafe_get table slot in
  if entry = 0 then slot
  else if entry land lnot number_mask = tag then begin
    let i = (entry land number_mask) - 1 in
    if same (chunk t i) ((i land chunk_mask) * t.words) keys at (t.words - 1) then slot
    else probe t table keys at tag ((slot + 1) land t.mask)
  end
  else probe t table keys at tag ((slot + 1) land t.mask)

(* Likewise in a bare table. *)
let rec probe_bare (table : words_of_chunk) mask entry slot =
  let there = Array1.unsafe_get table slot in
  if there = entry || there = 0 then slot else probe_bare table mask entry ((slot + 1) land mask)

let rec free (table : words_of_chunk) mask slot =
  if Array1.unsafe_get table slot = 0 then slot else free table mask ((slot + 1) land mask)

let fill t =
  let key = Array.make t.words 0 in
  for i = 0 to t.count - 1 do
    load t i key;
    let h = hash t key in
    let entry = if t.bare then key.(0) + 1 else tag_of h lor (i + 1) in
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
  t.most <- most_of slots;
  fill t

(* The old table is given back before there is a new one: the states can fill it again. If there is no memory for the
   new one, there is for one like the old one. *)
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
  let tag = tag_of h in
  let slot = probe t t.table keys at tag (h land t.mask) in
  let entry = Array1.unsafe_get t.table slot in
  if entry <> 0 then (entry land number_mask) - 1
  else begin
    let i = t.count in
    append t keys at ~parent;
    Array1.unsafe_set t.table slot (tag lor (i + 1));
    if t.count > t.most then resize t (2 * (t.mask + 1));
    -1 - i
  end

let add_bare t keys at h ~parent ~fresh =
  let word = Array.unsafe_get keys at in
  let slot = probe_bare t.table t.mask (word + 1) (h land t.mask) in
  if Array1.unsafe_get t.table slot = 0 then begin
    let i = t.count in
    append t keys at ~parent;
    Array1.unsafe_set t.table slot (word + 1);
    if t.count > t.most then resize t (2 * (t.mask + 1));
    fresh i word
  end

(* {1 Many at a time}

   Looking for a state costs two reads of memory, of the table and of the state found there, and little else. A
   processor waits for many reads at once if they do not depend on each other: so the table is read for all that wait,
   then the states, and only then are they added, from the caches. A bare table has the states, and there is only one
   read. *)

let read_tables t =
  let waiting = t.waiting and table : words_of_chunk = t.table and mask = t.mask in
  let seen = ref 0 in
  for k = 0 to waiting.length - 1 do
    seen := !seen lxor Array1.unsafe_get table (Array.unsafe_get waiting.hashes k land mask)
  done;
  ignore (Sys.opaque_identity !seen)

let read_states t =
  let waiting = t.waiting and table : words_of_chunk = t.table and mask = t.mask in
  let seen = ref 0 in
  for k = 0 to waiting.length - 1 do
    let i = (Array1.unsafe_get table (Array.unsafe_get waiting.hashes k land mask) land number_mask) - 1 in
    if i >= 0 then seen := !seen lxor word (chunk t i) ((i land chunk_mask) * t.words)
  done;
  ignore (Sys.opaque_identity !seen)

let flush t ~fresh =
  let waiting = t.waiting in
  read_tables t;
  if not t.bare then read_states t;
  for k = 0 to waiting.length - 1 do
    let at = k * t.words in
    let parent = Array.unsafe_get waiting.from k and h = Array.unsafe_get waiting.hashes k in
    if t.bare then add_bare t waiting.keys at h ~parent ~fresh
    else begin
      let i = add_at t waiting.keys at h ~parent in
      if i < 0 then fresh (-1 - i) (Array.unsafe_get waiting.keys at)
    end
  done;
  waiting.length <- 0

let push t (key : int array) ~parent ~fresh =
  let waiting = t.waiting in
  let k = waiting.length in
  let at = k * t.words in
  for w = 0 to t.words - 1 do
    Array.unsafe_set waiting.keys (at + w) (Array.unsafe_get key w)
  done;
  Array.unsafe_set waiting.hashes k (hash t key);
  Array.unsafe_set waiting.from k parent;
  waiting.length <- k + 1;
  if k + 1 = most_waiting then flush t ~fresh

let find t key =
  number_all t;
  let h = hash t key in
  let slot = probe t t.table key 0 (tag_of h) (h land t.mask) in
  (t.table.{slot} land number_mask) - 1

(* {1 Others' states} *)

let number_of_entry entry = (entry land number_mask) - 1
let entry_of h i = tag_of h lor (i + 1)
let is_tagged h entry = entry land lnot number_mask = tag_of h
let parents t = t.parents
let room t = max 1 (min t.most (Array.length t.chunks * chunk_states) - (2 * most_waiting))
let table t = t.table

let clear t =
  t.count <- 0;
  t.bare <- false;
  t.parents <- Parents.create ();
  t.waiting.length <- 0;
  Array1.fill t.table 0

(* Where states wait to be added, others' states stand meanwhile. *)
let members t source ~first ~n f =
  number_all t;
  let waiting = t.waiting and key = Array.make t.words 0 in
  for k = 0 to n - 1 do
    for w = 0 to t.words - 1 do
      let word = Int64.to_int (Bytes.get_int64_le source (8 * (((first + k) * t.words) + w))) in
      Array.unsafe_set key w word;
      Array.unsafe_set waiting.keys ((k * t.words) + w) word
    done;
    Array.unsafe_set waiting.hashes k (hash t key)
  done;
  waiting.length <- n;
  read_tables t;
  read_states t;
  for k = 0 to n - 1 do
    let h = Array.unsafe_get waiting.hashes k in
    let slot = probe t t.table waiting.keys (k * t.words) (tag_of h) (h land t.mask) in
    let entry = Array1.unsafe_get t.table slot in
    if entry <> 0 then f (number_of_entry entry)
  done;
  waiting.length <- 0

let bytes_of_chunk t = chunk_states * 8 * t.words
let bytes t = (Array.length t.chunks * bytes_of_chunk t) + (8 * (t.mask + 1)) + Parents.bytes t.parents

let bytes_to_grow t ~by =
  let table = if t.count + by > t.most then 8 * (t.mask + 1) else 0 in
  let chunks = ((t.count + by) lsr chunk_bits) + 1 - Array.length t.chunks in
  table + (max 0 chunks * bytes_of_chunk t)

let bytes_to_rewrite t ~words = if words = t.words then 0 else Array.length t.chunks * chunk_states * 8 * words
let forget_waiting t = t.waiting.length <- 0

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
  let t = { t with words; waiting = nothing_waits words; bare = t.bare && words = 1 } in
  Array1.fill t.table 0;
  fill t;
  t
