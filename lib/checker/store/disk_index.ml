open Bigarray

(* The table is in parts, each as long as the memory. The hash of a state determines its part and its first slot;
   behind the last slot of a part comes its first one. *)
type t = {
  file : Disk_file.t;
  part : int;  (* slots of a part *)
  parts : int;
  window : Bytes.t;
}

let window_slots = 64

(* At most two thirds full. *)
let rec parts_for ~states ~part parts =
  if parts * part * 2 >= states * 3 then parts else parts_for ~states ~part (2 * parts)

let rec bits n = if n <= 1 then 0 else 1 + bits (n / 2)
let part_of t h = (h lsr bits t.part) land (t.parts - 1)

let rec free (memory : (int, int_elt, c_layout) Array1.t) mask slot =
  if memory.{slot} = 0 then slot else free memory mask ((slot + 1) land mask)

let create ~directory ~states ~memory each =
  let part = Array1.dim memory in
  let parts = parts_for ~states ~part 1 in
  let t = { file = Disk_file.create ~directory; part; parts; window = Bytes.create (8 * window_slots) } in
  let mask = part - 1 in
  for p = 0 to parts - 1 do
    Array1.fill memory 0;
    each (fun i h -> if part_of t h = p then memory.{free memory mask (h land mask)} <- Slot.entry h i);
    for slot = 0 to part - 1 do
      Disk_file.append t.file memory.{slot}
    done
  done;
  t

let find t h is_it =
  let start = part_of t h * t.part in
  let rec from slot =
    let n = min window_slots (t.part - slot) in
    Disk_file.read t.file ~at:(start + slot) t.window ~words:n;
    let entry k = Int64.to_int (Bytes.get_int64_le t.window (8 * k)) in
    let rec within k =
      if k = n then `Further
      else if entry k = 0 then `Found (-1)
      else if Slot.is_tagged h (entry k) && is_it (Slot.number (entry k)) then
        `Found (Slot.number (entry k))
      else within (k + 1)
    in
    match within 0 with `Found i -> i | `Further -> from ((slot + n) land (t.part - 1))
  in
  from (h land (t.part - 1))

let close t = Disk_file.close t.file
