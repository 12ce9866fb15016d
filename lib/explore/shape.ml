open Dolphin_semantics

type frame = { frame : int; machine : Machine.t; mutable over : int array }

type t = {
  number : int;
  frame : frame;
  families : Parts.family array;
  mutable word : int array;
  mutable shift : int array;
  mutable mask : int array;
  without : t option array;
  becoming : (int, t) Hashtbl.t;
}

let bits_of_word = 63

type widths = { shape : int; shared : int }

let lay_out widths s =
  let n = Array.length s.families in
  s.word <- Array.make n 0;
  s.shift <- Array.make n 0;
  s.mask <- Array.make n 0;
  let place (word, bit) i (family : Parts.family) =
    let word, bit = if bit + family.width > bits_of_word then (word + 1, 0) else (word, bit) in
    s.word.(i) <- word;
    s.shift.(i) <- bit;
    s.mask.(i) <- (1 lsl family.width) - 1;
    (word, bit + family.width)
  in
  let rec from i at = if i = n then at else from (i + 1) (place at i s.families.(i)) in
  fst (from 0 (0, widths.shape + widths.shared)) + 1
