type node =
  | Word of int * Integer_set.t  (* values of the word at this place *)
  | Pair of Integer_set.t * node * node

type t = {
  words : int;
  root : node;
  top : Integer_set.t;  (* of the root: a number there is a state's number *)
  parents : Parents.t;
  (* States to be added, by their order: the number at the top, the first word, the parent. *)
  tops : int array;
  firsts : int array;
  from : int array;
  mutable waiting : int;
}

let rec node numbers low high =
  if high - low = 1 then Word (low, numbers)
  else
    let middle = (low + high) / 2 in
    Pair (numbers, node (Integer_set.create ()) low middle, node (Integer_set.create ()) middle high)

let numbers = function Word (_, numbers) | Pair (numbers, _, _) -> numbers
let most_waiting = 192

let of_top top parents ~words =
  let array () = Array.make most_waiting 0 in
  { words; root = node top 0 words; top; parents; tops = array (); firsts = array (); from = array (); waiting = 0 }

let create ~words = of_top (Integer_set.create ()) (Parents.create ()) ~words
let words t = t.words
let count t = Integer_set.count t.top

(* {1 Pairs}

   Two numbers of 31 bits side by side, byte by byte, so that small ones make a small pair. *)

let spread x = x land 0xFF lor ((x land 0xFF00) lsl 8) lor ((x land 0xFF_0000) lsl 16) lor ((x land 0x7F00_0000) lsl 24)

let gather x =
  x land 0xFF lor ((x lsr 8) land 0xFF00) lor ((x lsr 16) land 0xFF_0000) lor ((x lsr 24) land 0x7F00_0000)

let most_numbers = 0x7FFF_FFFF
let pair a b = if a > most_numbers || b > most_numbers then raise Out_of_memory else spread a lor (spread b lsl 8)

(* The number of the node's part of [key], which is added below the top. *)
let rec inner node key =
  let i = Integer_set.add (numbers node) (value node key) in
  if i < 0 then -1 - i else i

and value node (key : int array) =
  match node with
  | Word (w, _) -> Array.unsafe_get key w
  | Pair (_, left, right) ->
    let a = inner left key in
    pair a (inner right key)

let rec unfold node x (key : int array) =
  match node with
  | Word (w, _) -> key.(w) <- x
  | Pair (_, left, right) ->
    unfold left (Integer_set.get (numbers left) (gather x)) key;
    unfold right (Integer_set.get (numbers right) (gather (x lsr 8))) key

let load t i key = unfold t.root (Integer_set.get t.top i) key

exception Unknown

let rec known node (key : int array) =
  match node with
  | Word (w, _) -> key.(w)
  | Pair (_, left, right) ->
    let number node =
      match Integer_set.find (numbers node) (known node key) with -1 -> raise_notrace Unknown | i -> i
    in
    let a = number left in
    pair a (number right)

let find t key = match known t.root key with x -> Integer_set.find t.top x | exception Unknown -> -1
let parent t i = Parents.get t.parents i

(* {1 Many at a time, as in [Packed]} *)

let flush t ~fresh =
  let seen = ref 0 in
  for k = 0 to t.waiting - 1 do
    seen := !seen lxor Integer_set.read_table t.top (Array.unsafe_get t.tops k)
  done;
  for k = 0 to t.waiting - 1 do
    seen := !seen lxor Integer_set.read_number t.top (Array.unsafe_get t.tops k)
  done;
  ignore (Sys.opaque_identity !seen);
  for k = 0 to t.waiting - 1 do
    let i = Integer_set.add t.top (Array.unsafe_get t.tops k) in
    if i < 0 then begin
      Parents.add t.parents (Array.unsafe_get t.from k);
      fresh (-1 - i) (Array.unsafe_get t.firsts k)
    end
  done;
  t.waiting <- 0

let push t key ~parent ~fresh =
  let k = t.waiting in
  t.tops.(k) <- value t.root key;
  t.firsts.(k) <- key.(0);
  t.from.(k) <- parent;
  t.waiting <- k + 1;
  if k + 1 = most_waiting then flush t ~fresh

(* {1 Memory} *)

let rec sum f node =
  f (numbers node) + match node with Word _ -> 0 | Pair (_, left, right) -> sum f left + sum f right

let bytes t = sum Integer_set.bytes t.root + Parents.bytes t.parents
let bytes_to_grow t ~by = sum (Integer_set.bytes_to_grow ~by) t.root

(* Numbers at the top may become wider. *)
let bytes_to_rewrite t = 8 * count t
let forget_waiting t = t.waiting <- 0

(* The tops stay where they are: there are many of them. The part below is rebuilt. *)
let rewrite t ~words f =
  let renewed = of_top t.top t.parents ~words in
  let old = Array.make t.words 0 and fresh = Array.make words 0 in
  let renew x =
    unfold t.root x old;
    Array.fill fresh 0 words 0;
    f old fresh;
    value renewed.root fresh
  in
  Integer_set.renew t.top renew;
  renewed
