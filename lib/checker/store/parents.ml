open Bigarray

(* State after state, a one for each number by which the parent has grown, and a zero: state [i] with parent [p] has
   its zero at bit
   [i + p]. All bits are one at first. *)

type chunk = (int, int8_unsigned_elt, c_layout) Array1.t

type t = {
  mutable chunks : chunk array;
  mutable count : int;
  mutable samples : int array;  (* the parent of every 512th state *)
}

let chunk_bytes = 1 lsl 14
let sample_bits = 9
let create () = { chunks = [||]; count = 0; samples = [||] }

let rec reserve t byte =
  if byte / chunk_bytes >= Array.length t.chunks then begin
    let chunk = Array1.create int8_unsigned c_layout chunk_bytes in
    Array1.fill chunk 0xFF;
    t.chunks <- Array.append t.chunks [| chunk |];
    reserve t byte
  end

let byte t i = Array1.get (Array.unsafe_get t.chunks (i / chunk_bytes) : chunk) (i land (chunk_bytes - 1))

let add t p =
  let i = t.count in
  let bit = i + p in
  reserve t (bit lsr 3);
  if i land ((1 lsl sample_bits) - 1) = 0 then begin
    let k = i lsr sample_bits in
    if k = Array.length t.samples then t.samples <- Array.append t.samples (Array.make (max 16 k) 0);
    t.samples.(k) <- p
  end;
  let chunk : chunk = t.chunks.(bit lsr 3 / chunk_bytes) and at = (bit lsr 3) land (chunk_bytes - 1) in
  chunk.{at} <- chunk.{at} land lnot (1 lsl (bit land 7));
  t.count <- i + 1

(* The place of the zero that is [more] zeros after the one at [bit]. *)
let rec skip t bit more =
  if more = 0 then bit
  else
    let rec next bit =
      if bit land 7 = 0 && byte t (bit lsr 3) = 0xFF then next (bit + 8)
      else if byte t (bit lsr 3) land (1 lsl (bit land 7)) = 0 then bit
      else next (bit + 1)
    in
    skip t (next (bit + 1)) (more - 1)

let count t = t.count

let get t i =
  let k = i lsr sample_bits in
  let first = k lsl sample_bits in
  skip t (first + t.samples.(k)) (i - first) - i

let bytes t = (Array.length t.chunks * chunk_bytes) + (8 * Array.length t.samples)
