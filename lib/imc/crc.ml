(* [table.(b)] is the remainder of the byte [b]. The polynomial is 0x8005, reflected 0xA001. *)
let table =
  let step crc = if crc land 1 = 1 then (crc lsr 1) lxor 0xA001 else crc lsr 1 in
  let rec steps n crc = if n = 0 then crc else steps (n - 1) (step crc) in
  Array.init 256 (steps 8)

let arc s ~pos ~len =
  if pos < 0 || len < 0 || pos > String.length s - len then invalid_arg "Crc.arc";
  let crc = ref 0 in
  for i = pos to pos + len - 1 do
    (* Both indices are in range: the bytes by the check above, the table's by the mask. *)
    let byte = Char.code (String.unsafe_get s i) in
    crc := Array.unsafe_get table ((!crc lxor byte) land 0xFF) lxor (!crc lsr 8)
  done;
  !crc
