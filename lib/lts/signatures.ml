(* Signatures stand one after the other in [store], each from [starts.(number)] to [starts.(number + 1) - 1]: the
   block of the state, then its transitions in ascending order. *)
type t = {
  mutable store : int array;
  mutable used : int;  (* up to here [store] holds signatures *)
  mutable filled : int;  (* up to here it holds the one that was started *)
  mutable starts : int array;
  mutable hashes : int array;
  mutable count : int;
  mutable slots : int array;  (* open addressing: the number of a signature, or [free] *)
}

let free = -1

let create () =
  {
    store = Array.make 1024 0;
    used = 0;
    filled = 0;
    starts = Array.make 65 0;
    hashes = Array.make 64 0;
    count = 0;
    slots = Array.make 256 free;
  }

let count t = t.count
let slot_of t hash = hash land (Array.length t.slots - 1)

(* The slot of the first signature that [found] accepts, or the free one where the search ends. *)
let rec probe t found slot =
  let number = t.slots.(slot) in
  if number = free || found number then slot else probe t found ((slot + 1) land (Array.length t.slots - 1))

let never _ = false

let clear t =
  if 16 * t.count > Array.length t.slots then Array.fill t.slots 0 (Array.length t.slots) free
  else
    (* Latest first: so the way to each slot is as it was when the slot was taken. *)
    for number = t.count - 1 downto 0 do
      t.slots.(probe t (Int.equal number) (slot_of t t.hashes.(number))) <- free
    done;
  t.count <- 0;
  t.used <- 0;
  t.filled <- 0

let grown array length =
  let larger = Array.make (2 * Array.length array) 0 in
  Array.blit array 0 larger 0 length;
  larger

let push t x =
  if t.filled = Array.length t.store then t.store <- grown t.store t.filled;
  t.store.(t.filled) <- x;
  t.filled <- t.filled + 1

let start t block =
  t.filled <- t.used;
  push t block

let add t ~label ~block = push t ((label lsl 31) lor block)

(* Sorts [store] from [low] to [high - 1]. *)
let sort store low high =
  if high - low <= 16 then
    for i = low + 1 to high - 1 do
      let x = store.(i) in
      let j = ref (i - 1) in
      while !j >= low && store.(!j) > x do
        store.(!j + 1) <- store.(!j);
        decr j
      done;
      store.(!j + 1) <- x
    done
  else begin
    let part = Array.sub store low (high - low) in
    Array.stable_sort Int.compare part;
    Array.blit part 0 store low (high - low)
  end

(* Removes repetitions from the sorted [store], [low] to [high - 1]: the new [high]. *)
let without_repetition store low high =
  let kept = ref low in
  for i = low to high - 1 do
    if !kept = low || store.(!kept - 1) <> store.(i) then begin
      store.(!kept) <- store.(i);
      incr kept
    end
  done;
  !kept

let hash store low high =
  let hash = ref (high - low) in
  for i = low to high - 1 do
    let mixed = (!hash lxor store.(i)) * 0x1f3d5b79a2c4e683 in
    hash := mixed lxor (mixed lsr 29)
  done;
  !hash land max_int

let equal t number low high =
  let start = t.starts.(number) in
  t.starts.(number + 1) - start = high - low
  &&
  let rec same i = i = high - low || (t.store.(start + i) = t.store.(low + i) && same (i + 1)) in
  same 0

let enlarge_slots t =
  t.slots <- Array.make (2 * Array.length t.slots) free;
  for number = 0 to t.count - 1 do
    t.slots.(probe t never (slot_of t t.hashes.(number))) <- number
  done

let finish ~counting t =
  let low = t.used in
  sort t.store (low + 1) t.filled;
  if not counting then t.filled <- without_repetition t.store (low + 1) t.filled;
  let hash = hash t.store low t.filled in
  let found number = t.hashes.(number) = hash && equal t number low t.filled in
  let slot = probe t found (slot_of t hash) in
  if t.slots.(slot) <> free then t.slots.(slot)
  else begin
    let number = t.count in
    if number = Array.length t.hashes then begin
      t.hashes <- grown t.hashes number;
      t.starts <- grown t.starts (number + 1)
    end;
    t.slots.(slot) <- number;
    t.hashes.(number) <- hash;
    t.count <- number + 1;
    t.used <- t.filled;
    t.starts.(t.count) <- t.used;
    if 2 * t.count > Array.length t.slots then enlarge_slots t;
    number
  end
