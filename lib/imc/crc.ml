(* [one.(b)] is the remainder of the byte [b]. The polynomial is 0x8005, reflected 0xA001. *)
let one =
  let step crc = if crc land 1 = 1 then (crc lsr 1) lxor 0xA001 else crc lsr 1 in
  let rec steps n crc = if n = 0 then crc else steps (n - 1) (step crc) in
  Array.init 256 (steps 8)

(* Those of a byte with one, two, three zeros after it: so four bytes need not wait for each other. Kounavis, Berry:
   Novel table lookup-based algorithms for high-performance CRC generation, 2008. *)
let shifted table = Array.map (fun crc -> (crc lsr 8) lxor one.(crc land 0xFF)) table
let two = shifted one
let three = shifted two
let four = shifted three

let arc s ~pos ~len =
  if pos < 0 || len < 0 || pos > String.length s - len then invalid_arg "Crc.arc";
  (* All indices are in range: those of bytes by the check above, those of tables by the masks. *)
  let byte i = Char.code (String.unsafe_get s i) in
  let lookup table i = Array.unsafe_get table (i land 0xFF) in
  let crc = ref 0 and i = ref pos in
  let stop = pos + len in
  while !i + 4 <= stop do
    let low = !crc lxor byte !i and high = (!crc lsr 8) lxor byte (!i + 1) in
    crc := lookup four low lxor lookup three high lxor lookup two (byte (!i + 2)) lxor lookup one (byte (!i + 3));
    i := !i + 4
  done;
  while !i < stop do
    crc := lookup one (!crc lxor byte !i) lxor (!crc lsr 8);
    incr i
  done;
  !crc
