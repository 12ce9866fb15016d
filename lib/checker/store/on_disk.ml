exception Failed = Disk_file.Failed

type t = {
  words : int;
  directory : string;
  tick : unit -> unit;
  file : Disk_file.t;
  parents : Parents.t;
  mutable count : int;
  pushed : Packed.t;  (* candidates for new states *)
  capacity : int;  (* states of [pushed] when it is full *)
  mutable is_empty : bool;  (* [pushed], with its waiting states *)
  mutable first_parent : int;  (* for pushed states: parents are kept there less this one *)
  window : Bytes.t;  (* some states of the file, as they are read one after the other *)
  mutable window_from : int;
  mutable window_states : int;
  one : Bytes.t;  (* for a single state *)
  mutable index : (int * Disk_index.t) option;  (* with the number of states in it *)
}

let window_bytes = 1 lsl 16
let words t = t.words
let count t = t.count

(* {1 Reading} *)

let states_of_window t = max 1 (window_bytes / (8 * t.words))

(* Makes the window begin with state [i]. *)
let move_window t i =
  let n = min (states_of_window t) (t.count - i) in
  Disk_file.read t.file ~at:(i * t.words) t.window ~words:(n * t.words);
  t.window_from <- i;
  t.window_states <- n

let word t i w = Int64.to_int (Bytes.get_int64_le t.window (8 * (((i - t.window_from) * t.words) + w)))

let load t i key =
  if i < t.window_from || i >= t.window_from + t.window_states then move_window t i;
  for w = 0 to t.words - 1 do
    key.(w) <- word t i w
  done

let forget_window t = t.window_states <- 0
let parent t i = Parents.get t.parents i

(* All states of the file, in order. *)
let each t f =
  let key = Array.make t.words 0 in
  for i = 0 to t.count - 1 do
    if i land 0xFFFF = 0 then t.tick ();
    load t i key;
    f i key
  done

(* {1 Adding} *)

(* Which of those that were pushed are on disk. *)
let known t =
  let known = Bytes.make (Packed.count t.pushed) '\000' in
  let note i = Bytes.unsafe_set known i '\001' in
  let rec of_window first =
    if first < t.window_states then begin
      let n = min Pending.most (t.window_states - first) in
      Packed.members t.pushed t.window ~first ~n note;
      of_window (first + n)
    end
  in
  let rec from i ticks =
    if i < t.count then begin
      if ticks land 0xF = 0 then t.tick ();
      move_window t i;
      of_window 0;
      from (i + t.window_states) (ticks + 1)
    end
  in
  from 0 1;
  known

let write t key =
  for w = 0 to t.words - 1 do
    Disk_file.append t.file key.(w)
  done;
  t.count <- t.count + 1

let forget_waiting t =
  Packed.clear t.pushed;
  t.is_empty <- true

let flush t ~fresh =
  Packed.flush t.pushed ~fresh:(fun _ _ -> ());
  let n = Packed.count t.pushed in
  if n > 0 then begin
    let known = known t and key = Array.make t.words 0 in
    forget_window t;
    for k = 0 to n - 1 do
      if Bytes.get known k = '\000' then begin
        Packed.load t.pushed k key;
        let i = t.count in
        write t key;
        Parents.add t.parents (t.first_parent + Packed.parent t.pushed k);
        fresh i key.(0)
      end
    done;
    forget_waiting t
  end

let push t key ~parent ~fresh =
  if Packed.count t.pushed >= t.capacity then flush t ~fresh;
  if t.is_empty then t.first_parent <- parent;
  t.is_empty <- false;
  Packed.push t.pushed key ~parent:(parent - t.first_parent) ~fresh:(fun _ _ -> ())

(* {1 Looking for states} *)

let index t =
  match t.index with
  | Some (states, index) when states = t.count -> index
  | (Some _ | None) as before ->
    if not t.is_empty then invalid_arg "On_disk.find: something waits to be added";
    Option.iter (fun (_, index) -> Disk_index.close index) before;
    t.index <- None;
    let memory = Packed.table t.pushed in
    let each f = each t (fun i key -> f i (Slot.hash ~words:(words t) key)) in
    let index = Disk_index.create ~directory:t.directory ~states:t.count ~memory each in
    Packed.clear t.pushed;
    t.index <- Some (t.count, index);
    index

let find t key =
  let index = index t in
  let is_it i =
    Disk_file.read t.file ~at:(i * t.words) t.one ~words:t.words;
    let rec same w = w = t.words || (Int64.to_int (Bytes.get_int64_le t.one (8 * w)) = key.(w) && same (w + 1)) in
    same 0
  in
  Disk_index.find index (Slot.hash ~words:(words t) key) is_it

let close t =
  Disk_file.close t.file;
  Option.iter (fun (_, index) -> Disk_index.close index) t.index

(* {1 Memory} *)

let bytes t = Packed.bytes t.pushed + Parents.bytes t.parents + window_bytes

(* {1 Making} *)

let make ~directory ~tick ~words ~capacity parents pushed =
  { words; directory; tick; file = Disk_file.create ~directory; parents; count = 0; pushed; capacity; is_empty = true;
    first_parent = 0; window = Bytes.create (max window_bytes (8 * words)); window_from = 0; window_states = 0;
    one = Bytes.create (8 * words);
    index = None }

let of_packed packed ~directory ~tick =
  let words = Packed.words packed and count = Packed.count packed in
  let t = make ~directory ~tick ~words ~capacity:(Packed.room packed) (Packed.parents packed) packed in
  let key = Array.make words 0 in
  for i = 0 to count - 1 do
    if i land 0xFFFF = 0 then tick ();
    Packed.load packed i key;
    write t key
  done;
  Packed.clear packed;
  t

let rewrite before ~words f =
  let { directory; tick; parents; pushed; capacity; _ } = before in
  let pushed, capacity =
    if words = before.words then (pushed, capacity)
    else (Packed.create ~words, max 1 (capacity * before.words / words))  (* of the same size in the end *)
  in
  let t = make ~directory ~tick ~words ~capacity parents pushed and fresh = Array.make words 0 in
  let renew _ old =
    Array.fill fresh 0 words 0;
    f old fresh;
    write t fresh
  in
  each { before with tick = ignore } renew;
  close before;
  t
