open Bigarray

type table = (int, int_elt, c_layout) Array1.t

let most slots = slots / 10 * 7

(* Arrays are indexed without checks: a key has its words, and slots are within the mask. *)

let mix h k =
  let h = (h lxor k) * 0x1E37_79B9_7F4A_7C15 in
  h lxor (h lsr 32)

let hash ~words (key : int array) =
  let h = ref (mix 0 (Array.unsafe_get key 0)) in
  for w = 1 to words - 1 do
    h := mix !h (Array.unsafe_get key w)
  done;
  !h

let number_mask = 0xFFFF_FFFF
let tag h = (h lsr 1) land lnot number_mask
let entry h i = tag h lor (i + 1)
let is_tagged h entry = entry land lnot number_mask = tag h
let number entry = (entry land number_mask) - 1

let rec find_bare (table : table) mask x slot =
  let there = Array1.unsafe_get table slot in
  if there = x || there = 0 then slot else find_bare table mask x ((slot + 1) land mask)
