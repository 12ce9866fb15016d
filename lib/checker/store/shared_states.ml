open Bigarray

type t = {
  words : int;
  workers : int;
  mutable me : int;
  states : Shared_memory.words;  (* by number *)
  before : Parents.t;  (* of the states before there were several workers *)
  places : (int, int8_unsigned_elt) Shared_memory.t;  (* by number: the place of the parent in its run *)
  runs : Shared_memory.words;  (* by worker: the first place in its segment, and the number of the first parent *)
  most_runs : int;
  tables : Shared_memory.words;  (* a table of [n] slots is the [n] words from the [n]th on *)
  chunks : Shared_memory.words;  (* by worker and place: the chunks of its segment *)
  most_chunks : int;
  owners : Shared_memory.words;  (* by chunk: the worker, and which of its chunks it is *)
  control : Shared_memory.words;
  mutable own : int;  (* states in this worker's segment *)
  mutable own_runs : int;
  mutable run : int;  (* the first parent of the latest *)
  mutable bare : bool;  (* as in {!Packed} *)
  mutable table : Slot.table;
  mutable mask : int;
  mutable most : int;
  mutable grow : t -> unit;
  waiting : Pending.t;
}

let chunk_bits = 16
let chunk_states = 1 lsl chunk_bits
let chunk_mask = chunk_states - 1

(* {1 Communication between processes}

   Words that several of them write have cache lines of their own. *)

let line = 16
let next_chunk = 0
let slots_now = line
let filled_by w = line * (2 + w)
let runs_by w = filled_by w + 1
let words t = t.words

(* No parent is in the run that others may have begun. *)
let no_run = -1_000

let become t w =
  t.me <- w;
  t.own <- Shared_memory.read t.control (filled_by w);
  t.own_runs <- Shared_memory.read t.control (runs_by w);
  t.run <- no_run

let filled t w = Shared_memory.read t.control (filled_by w)

let count t =
  let rec from w n = if w = t.workers then n else from (w + 1) (n + filled t w) in
  from 0 0

let publish t =
  Shared_memory.write t.control (runs_by t.me) t.own_runs;
  Shared_memory.write t.control (filled_by t.me) t.own
let chunk_at t w k = Array1.unsafe_get t.chunks ((w * t.most_chunks) + k)
let number t w p = (chunk_at t w (p lsr chunk_bits) lsl chunk_bits) lor (p land chunk_mask)

(* The number of the next state of this worker. *)
let next_number t =
  if t.own land chunk_mask = 0 && chunk_at t t.me (t.own lsr chunk_bits) < 0 then begin
    let c = Shared_memory.add t.control next_chunk 1 in
    if c >= t.most_chunks || ((c + 1) lsl chunk_bits) * t.words > Array1.dim t.states then raise Out_of_memory;
    Array1.unsafe_set t.chunks ((t.me * t.most_chunks) + (t.own lsr chunk_bits)) c;
    Array1.unsafe_set t.owners c ((t.own lsr chunk_bits * t.workers) + t.me)
  end;
  number t t.me t.own

(* {1 States} *)

let load t i key =
  let base = i * t.words in
  for w = 0 to t.words - 1 do
    Array.unsafe_set key w (Array1.unsafe_get t.states (base + w))
  done

(* {2 Parents}

   A worker expands states in blocks, so the parents of the states that it adds are close to each other for a while:
   such a run has parents less than 256 apart, and a state only the place of its parent there. *)

let longest_run = 256

let run_at t w r = ((w * t.most_runs) + r) * 2

(* Of the parent of the state that is added next. *)
let place_of t parent =
  let place = parent - t.run in
  if place >= 0 && place < longest_run then place
  else begin
    if t.own_runs >= t.most_runs then raise Out_of_memory;
    let at = run_at t t.me t.own_runs in
    Array1.unsafe_set t.runs at t.own;
    Array1.unsafe_set t.runs (at + 1) parent;
    t.own_runs <- t.own_runs + 1;
    t.run <- parent;
    0
  end

let parent t i =
  let owner = t.owners.{i lsr chunk_bits} in
  let w = owner mod t.workers in
  let at = (owner / t.workers * chunk_states) + (i land chunk_mask) in
  if w = 0 && at < Parents.count t.before then Parents.get t.before i
  else
    (* The last run that does not begin after it is from [low] on, and before [high]. *)
    let rec run low high =
      if high - low = 1 then t.runs.{run_at t w low + 1}
      else
        let middle = (low + high) / 2 in
        if t.runs.{run_at t w middle} <= at then run middle high else run low middle
    in
    run 0 (Shared_memory.read t.control (runs_by w)) + t.places.{i}

let rec same (states : Shared_memory.words) base (keys : int array) at w =
  w < 0
  || Array1.unsafe_get states (base + w) = Array.unsafe_get keys (at + w)
     && same states base keys at (w - 1)

let rec probe t (table : Slot.table) keys at tag slot =
  let entry = Array1.unsafe_get table slot in
  if entry = 0 then slot
  else if
    entry land lnot Slot.number_mask = tag
    && same t.states (((entry land Slot.number_mask) - 1) * t.words) keys at (t.words - 1)
  then slot
  else probe t table keys at tag ((slot + 1) land t.mask)

let write t i keys at =
  let base = i * t.words in
  for w = 0 to t.words - 1 do
    Array1.unsafe_set t.states (base + w) (Array.unsafe_get keys (at + w))
  done

let added t i word ~parent ~fresh =
  Array1.unsafe_set t.places i (place_of t parent);
  t.own <- t.own + 1;
  fresh i word

(* A state is written before its slot refers to it. If another process takes the slot, its entry is read. *)
let rec add_at t keys at h ~parent ~fresh slot =
  let slot = probe t t.table keys at (Slot.tag h) slot in
  if Array1.unsafe_get t.table slot = 0 then begin
    let i = next_number t in
    write t i keys at;
    if Shared_memory.swap t.table slot 0 (Slot.entry h i) then added t i (Array.unsafe_get keys at) ~parent ~fresh
    else add_at t keys at h ~parent ~fresh slot
  end

let rec add_bare t keys at ~parent ~fresh slot =
  let word = Array.unsafe_get keys at in
  let slot = Slot.find_bare t.table t.mask (word + 1) slot in
  if Array1.unsafe_get t.table slot = 0 then
    if Shared_memory.swap t.table slot 0 (word + 1) then begin
      let i = next_number t in
      write t i keys at;
      added t i word ~parent ~fresh
    end
    else add_bare t keys at ~parent ~fresh slot

(* {1 The table} *)

let set_table t slots =
  t.table <- Array1.sub t.tables slots slots;
  t.mask <- slots - 1;
  t.most <- Slot.most slots - (t.workers * Pending.most)

let rec put (table : Slot.table) mask entry slot =
  if not (Array1.unsafe_get table slot = 0 && Shared_memory.swap table slot 0 entry) then
    put table mask entry ((slot + 1) land mask)

(* Slots are read for many states, and only then written to, as in {!flush}. *)
let put_states t first n =
  let key = Array.make t.words 0 and hashes = Array.make Pending.most 0 in
  let put_some from n =
    let seen = ref 0 in
    for k = 0 to n - 1 do
      load t (from + k) key;
      let h = Slot.hash ~words:t.words key in
      Array.unsafe_set hashes k h;
      seen := !seen lxor Array1.unsafe_get t.table (h land t.mask)
    done;
    ignore (Sys.opaque_identity !seen);
    for k = 0 to n - 1 do
      let h = Array.unsafe_get hashes k and i = from + k in
      let entry = if t.bare then Array1.unsafe_get t.states i + 1 else Slot.entry h i in
      put t.table t.mask entry (h land t.mask)
    done
  in
  let rec from k =
    if k < n then begin
      put_some (first + k) (min Pending.most (n - k));
      from (k + Pending.most)
    end
  in
  from 0

(* Of all chunks, those whose turn is this worker's. *)
let each_chunk t f =
  let turn = ref 0 in
  for w = 0 to t.workers - 1 do
    let n = filled t w in
    for k = 0 to ((n + chunk_mask) lsr chunk_bits) - 1 do
      f !turn (chunk_at t w k lsl chunk_bits) (min chunk_states (n - (k lsl chunk_bits)));
      incr turn
    done
  done

let iter t f =
  let of_chunk _ first n = for i = first to first + n - 1 do f i done in
  each_chunk t of_chunk

let fill t = each_chunk t (fun _ first n -> put_states t first n)

let forget_table t =
  let slots = t.mask + 1 in
  Shared_memory.forget t.tables ~from:slots ~length:slots;
  Array1.fill t.table 0

let begin_growing t =
  let slots = t.mask + 1 in
  if 4 * slots > Array1.dim t.tables then raise Out_of_memory;
  Shared_memory.forget t.tables ~from:slots ~length:slots;
  Shared_memory.write t.control slots_now (2 * slots)

let fill_part t =
  set_table t (Shared_memory.read t.control slots_now);
  each_chunk t (fun turn first n -> if turn mod t.workers = t.me then put_states t first n)

let grow_alone t =
  begin_growing t;
  set_table t (Shared_memory.read t.control slots_now);
  fill t

let is_full t = count t > t.most
let when_full t grow = t.grow <- grow

(* {1 Many at a time} *)

let read_states t =
  let waiting = t.waiting and table : Slot.table = t.table and mask = t.mask in
  let seen = ref 0 in
  for k = 0 to waiting.length - 1 do
    let i = (Array1.unsafe_get table (Array.unsafe_get waiting.hashes k land mask) land Slot.number_mask) - 1 in
    if i >= 0 then seen := !seen lxor Array1.unsafe_get t.states (i * t.words)
  done;
  ignore (Sys.opaque_identity !seen)

let flush t ~fresh =
  if is_full t then t.grow t;
  let waiting = t.waiting in
  Pending.read_slots waiting t.table t.mask;
  if not t.bare then read_states t;
  for k = 0 to waiting.length - 1 do
    let at = k * t.words in
    let parent = Array.unsafe_get waiting.parents k and h = Array.unsafe_get waiting.hashes k in
    if t.bare then add_bare t waiting.keys at ~parent ~fresh (h land t.mask)
    else add_at t waiting.keys at h ~parent ~fresh (h land t.mask)
  done;
  Pending.clear waiting;
  publish t

let push t key ~parent ~fresh = if Pending.add t.waiting key ~parent then flush t ~fresh
let forget_waiting t = Pending.clear t.waiting

(* From now on the table has numbers. *)
let number_all t =
  if t.bare then begin
    t.bare <- false;
    forget_table t;
    fill t
  end

let find t key =
  number_all t;
  let h = Slot.hash ~words:t.words key in
  Slot.number t.table.{probe t t.table key 0 (Slot.tag h) (h land t.mask)}

let all_runs t =
  let rec from w n = if w = t.workers then n else from (w + 1) (n + Shared_memory.read t.control (runs_by w)) in
  from 0 0

let bytes t = (count t * ((8 * t.words) + 1)) + (8 * (t.mask + 1)) + (16 * all_runs t) + Parents.bytes t.before

let bytes_to_rewrite t ~words =
  let chunks = Shared_memory.read t.control next_chunk in
  if chunks * chunk_states * words > Array1.dim t.states then raise Out_of_memory;
  8 * count t * max 0 (words - t.words)

let bytes_to_grow t ~by =
  let states = by * ((8 * t.words) + 1) in
  if count t + by > t.most then states + (8 * (t.mask + 1)) else states

(* {1 Making and rewriting} *)

(* The highest first: no state is moved onto one that is still to be moved. *)
let rewrite t ~words f =
  let old = Array.make t.words 0 and fresh = Array.make words 0 in
  let chunks = ref [] in
  each_chunk t (fun _ first n -> chunks := (first, n) :: !chunks);
  let of_chunk (first, n) =
    for i = first + n - 1 downto first do
      load t i old;
      Array.fill fresh 0 words 0;
      f old fresh;
      for w = 0 to words - 1 do
        Array1.unsafe_set t.states ((i * words) + w) fresh.(w)
      done
    done
  in
  List.iter of_chunk (List.sort (fun (first, _) (first', _) -> Int.compare first' first) !chunks);
  let t = { t with words; waiting = Pending.create ~words; bare = t.bare && words = 1 } in
  forget_table t;
  fill t;
  t

(* Addresses for [room] words of states, and all that belongs to them. *)
let reserved packed ~workers room =
  let words = Packed.words packed and n = Packed.count packed in
  let most_chunks = (room lsr chunk_bits) + workers + 1 in
  let most = most_chunks lsl chunk_bits in
  let rec slots_for slots =
    if Slot.most slots - (workers * Pending.most) > 2 * n then slots else slots_for (2 * slots) in
  let rec largest slots = if 2 * slots >= room then slots else largest (2 * slots) in
  let slots = slots_for 4096 in
  let with_array kind n f =
    let array = Shared_memory.map kind n in
    try f array
    with Out_of_memory ->
      Shared_memory.unmap array;
      raise Out_of_memory
  in
  with_array int (line * (2 + workers)) @@ fun control ->
  with_array int (workers * most_chunks) @@ fun chunks ->
  with_array int (most + (workers * chunk_states * words)) @@ fun states ->
  with_array int8_unsigned most @@ fun places ->
  with_array int (workers * (room / 16)) @@ fun runs ->
  with_array int most_chunks @@ fun owners ->
  with_array int (2 * largest (2 * slots)) @@ fun tables ->
  let t =
    { words; workers; me = 0; states; before = Packed.parents packed; places; runs; most_runs = room / 32; tables;
      chunks; most_chunks; owners; control; own = n; own_runs = 0; run = no_run; bare = words = 1;
      table = tables; mask = 0; most = 0; grow = grow_alone; waiting = Pending.create ~words }
  in
  set_table t slots;
  Shared_memory.write t.control slots_now slots;
  t

(* As much as the machine has; with few addresses, a part of them, since others need some, too. *)
let rec reserved_for packed ~workers room =
  if room < 16 * Packed.words packed * (Packed.count packed + (workers * chunk_states)) then raise Out_of_memory;
  try reserved packed ~workers room with Out_of_memory -> reserved_for packed ~workers (room / 4)

let of_packed packed ~workers =
  let t = reserved_for packed ~workers (Shared_memory.machine_memory () / 8) in
  let words = t.words and n = t.own in
  Array1.fill t.chunks (-1);
  let chunks = (n + chunk_mask) lsr chunk_bits in
  for k = 0 to chunks - 1 do
    t.chunks.{k} <- k;
    t.owners.{k} <- k * workers
  done;
  Shared_memory.write t.control next_chunk chunks;
  let key = Array.make words 0 in
  for i = 0 to n - 1 do
    Packed.load packed i key;
    write t i key 0
  done;
  publish t;
  fill t;
  t

let close t =
  Shared_memory.unmap t.states;
  Shared_memory.unmap t.places;
  Shared_memory.unmap t.runs;
  Shared_memory.unmap t.owners;
  Shared_memory.unmap t.tables;
  Shared_memory.unmap t.chunks;
  Shared_memory.unmap t.control
