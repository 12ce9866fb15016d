open Bigarray

type t = { words : int; keys : int array; hashes : int array; parents : int array; mutable length : int }

(* As many as there are lines in the first caches, about. *)
let most = 192

let create ~words =
  let array n = Array.make n 0 in
  { words; keys = array (most * words); hashes = array most; parents = array most; length = 0 }

let clear w = w.length <- 0

let add w (key : int array) ~parent =
  let k = w.length in
  let at = k * w.words in
  for i = 0 to w.words - 1 do
    Array.unsafe_set w.keys (at + i) (Array.unsafe_get key i)
  done;
  Array.unsafe_set w.hashes k (Slot.hash ~words:w.words key);
  Array.unsafe_set w.parents k parent;
  w.length <- k + 1;
  k + 1 = most

let read_slots w (table : Slot.table) mask =
  let seen = ref 0 in
  for k = 0 to w.length - 1 do
    seen := !seen lxor Array1.unsafe_get table (Array.unsafe_get w.hashes k land mask)
  done;
  ignore (Sys.opaque_identity !seen)
