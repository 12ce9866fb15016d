(* The first [length] elements of [buffer]. Vectors that were appended to one another share [buffer] and [filled]:
   how many elements of it are in use by any of them. The longest one may fill the next place; for all others that
   place is beyond their [length], and so invisible. [buffer] of a vector that was not appended to is full. *)
type 'a t = { buffer : 'a array; length : int; filled : int ref }

(* Of a full buffer. It is never changed, as no place is left. *)
let full = ref max_int

let of_array buffer = { buffer; length = Array.length buffer; filled = full }
let empty = { buffer = [||]; length = 0; filled = full }

let to_array xs = if xs.length = Array.length xs.buffer then xs.buffer else Array.sub xs.buffer 0 xs.length
let of_list xs = of_array (Array.of_list xs)

let length xs = xs.length
let get xs i = if i < xs.length then xs.buffer.(i) else invalid_arg "Vector.get"

let to_list xs =
  let rec from i rest = if i < 0 then rest else from (i - 1) (xs.buffer.(i) :: rest) in
  from (xs.length - 1) []

(* A buffer is twice as long as its first vector, so that each element is copied once on average. *)
let least_room = 4

let append xs x =
  if xs.length < Array.length xs.buffer && !(xs.filled) = xs.length then begin
    xs.buffer.(xs.length) <- x;
    incr xs.filled;
    { xs with length = xs.length + 1 }
  end
  else begin
    let buffer = Array.make (max least_room (2 * xs.length)) x in
    Array.blit xs.buffer 0 buffer 0 xs.length;
    let length = xs.length + 1 in
    { buffer; length; filled = ref length }
  end

let concat xs ys =
  if ys.length = 1 then append xs ys.buffer.(0) else of_array (Array.append (to_array xs) (to_array ys))

let set xs i x =
  let copy = Array.sub xs.buffer 0 xs.length in
  copy.(i) <- x;
  of_array copy

let rec all holds xs i = i = xs.length || (holds xs.buffer.(i) && all holds xs (i + 1))
let for_all holds xs = all holds xs 0
let exists holds xs = not (for_all (fun x -> not (holds x)) xs)

let map f xs = of_array (Array.init xs.length (fun i -> f xs.buffer.(i)))
