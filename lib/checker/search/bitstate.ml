open Bigarray

type t = {
  bits : (int, int8_unsigned_elt, c_layout) Array1.t;
  mutable first : int;  (* of the present state: two hashes, from which all others are made *)
  mutable second : int;
  mutable set : int;  (* bits *)
  mutable states : int;
  mutable omitted : float;
  mutable complete : float;  (* the logarithm of the chance that none was omitted *)
}

let hashes = 3

let create ~bytes =
  let bits = Array1.create int8_unsigned c_layout bytes in
  Array1.fill bits 0;
  { bits; first = 0; second = 0; set = 0; states = 0; omitted = 0.; complete = 0. }

let bytes t = Array1.dim t.bits
let states t = t.states

(* {1 The present state} *)

let mix factor h k =
  let h = (h lxor k) * factor in
  h lxor (h lsr 32)

let first_factor = 0x1E37_79B9_7F4A_7C15
let second_factor = 0x2545_F491_4F6C_DD1D

(* Not small: a first number that is equal makes 0 of them, from which other states may begin alike. *)
let begin_state t =
  t.first <- 0x2D35_8DCC_AA6C_78A5;
  t.second <- 0x0BB6_7AE8_584C_AA73

let add t n =
  t.first <- mix first_factor t.first n;
  t.second <- mix second_factor t.second n

let hash t = t.first

(* The bit of the hash function with this number. *)
let bit t number =
  let h = mix first_factor (mix second_factor t.first (t.second + number)) t.second in
  h land max_int mod (8 * bytes t)

let is_set t bit = Array1.get t.bits (bit lsr 3) land (1 lsl (bit land 7)) <> 0

let is_marked t =
  let rec from number = number = hashes || (is_set t (bit t number) && from (number + 1)) in
  from 0

(* {1 What is left out} *)

let filled t = float_of_int t.set /. (8. *. float_of_int (bytes t))

(* As the bits are set now, a new state looks like an old one with chance [p]: so, until one does not, p / (1 - p) of
   them do. *)
let count t =
  let p = filled t ** float_of_int hashes in
  t.omitted <- t.omitted +. (p /. (1. -. p));
  t.complete <- t.complete +. Float.log1p (-.p);
  t.states <- t.states + 1

let mark t =
  count t;
  for number = 0 to hashes - 1 do
    let bit = bit t number in
    if not (is_set t bit) then begin
      t.set <- t.set + 1;
      Array1.set t.bits (bit lsr 3) (Array1.get t.bits (bit lsr 3) lor (1 lsl (bit land 7)))
    end
  done

type summary = { bytes : int; states : int; filled : float; omitted : float; omission : float }

let summary (t : t) =
  { bytes = bytes t; states = t.states; filled = filled t; omitted = t.omitted; omission = -.Float.expm1 t.complete }
