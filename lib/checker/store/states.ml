type t = As_it_is of Packed.t | Compressed of Tree.t

let create ~compress ~words = if compress then Compressed (Tree.create ~words) else As_it_is (Packed.create ~words)
let words = function As_it_is s -> Packed.words s | Compressed s -> Tree.words s
let count = function As_it_is s -> Packed.count s | Compressed s -> Tree.count s

let push t key ~parent ~fresh =
  match t with As_it_is s -> Packed.push s key ~parent ~fresh | Compressed s -> Tree.push s key ~parent ~fresh

let flush t ~fresh = match t with As_it_is s -> Packed.flush s ~fresh | Compressed s -> Tree.flush s ~fresh
let find t key = match t with As_it_is s -> Packed.find s key | Compressed s -> Tree.find s key
let load t i key = match t with As_it_is s -> Packed.load s i key | Compressed s -> Tree.load s i key
let parent t i = match t with As_it_is s -> Packed.parent s i | Compressed s -> Tree.parent s i
let bytes = function As_it_is s -> Packed.bytes s | Compressed s -> Tree.bytes s
let bytes_to_grow t ~by =
  match t with As_it_is s -> Packed.bytes_to_grow s ~by | Compressed s -> Tree.bytes_to_grow s ~by

let bytes_to_rewrite t ~words =
  match t with As_it_is s -> Packed.bytes_to_rewrite s ~words | Compressed s -> Tree.bytes_to_rewrite s

let forget_waiting = function As_it_is s -> Packed.forget_waiting s | Compressed s -> Tree.forget_waiting s

let rewrite t ~words f =
  match t with
  | As_it_is s -> As_it_is (Packed.rewrite s ~words f)
  | Compressed s -> Compressed (Tree.rewrite s ~words f)
