type t = As_it_is of Packed.t | Compressed of Tree.t | On_disk of On_disk.t | Shared of Shared_states.t

exception Disk_failed = Disk_file.Failed

let create ~compress ~words = if compress then Compressed (Tree.create ~words) else As_it_is (Packed.create ~words)

let words = function
  | As_it_is s -> Packed.words s
  | Compressed s -> Tree.words s
  | On_disk s -> On_disk.words s
  | Shared s -> Shared_states.words s

let count = function
  | As_it_is s -> Packed.count s
  | Compressed s -> Tree.count s
  | On_disk s -> On_disk.count s
  | Shared s -> Shared_states.count s

let push t key ~parent ~fresh =
  match t with
  | As_it_is s -> Packed.push s key ~parent ~fresh
  | Compressed s -> Tree.push s key ~parent ~fresh
  | On_disk s -> On_disk.push s key ~parent ~fresh
  | Shared s -> Shared_states.push s key ~parent ~fresh

let flush t ~fresh =
  match t with
  | As_it_is s -> Packed.flush s ~fresh
  | Compressed s -> Tree.flush s ~fresh
  | On_disk s -> On_disk.flush s ~fresh
  | Shared s -> Shared_states.flush s ~fresh

let find t key =
  match t with
  | As_it_is s -> Packed.find s key
  | Compressed s -> Tree.find s key
  | On_disk s -> On_disk.find s key
  | Shared s -> Shared_states.find s key

let load t i key =
  match t with
  | As_it_is s -> Packed.load s i key
  | Compressed s -> Tree.load s i key
  | On_disk s -> On_disk.load s i key
  | Shared s -> Shared_states.load s i key

let parent t i =
  match t with
  | As_it_is s -> Packed.parent s i
  | Compressed s -> Tree.parent s i
  | On_disk s -> On_disk.parent s i
  | Shared s -> Shared_states.parent s i

let bytes = function
  | As_it_is s -> Packed.bytes s
  | Compressed s -> Tree.bytes s
  | On_disk s -> On_disk.bytes s
  | Shared s -> Shared_states.bytes s

let bytes_to_grow t ~by =
  match t with
  | As_it_is s -> Packed.bytes_to_grow s ~by
  | Compressed s -> Tree.bytes_to_grow s ~by
  | On_disk _ -> 0
  | Shared s -> Shared_states.bytes_to_grow s ~by

let bytes_to_rewrite t ~words =
  match t with
  | As_it_is s -> Packed.bytes_to_rewrite s ~words
  | Compressed s -> Tree.bytes_to_rewrite s
  | On_disk _ -> 0
  | Shared s -> Shared_states.bytes_to_rewrite s ~words

let forget_waiting = function
  | As_it_is s -> Packed.forget_waiting s
  | Compressed s -> Tree.forget_waiting s
  | On_disk s -> On_disk.forget_waiting s
  | Shared s -> Shared_states.forget_waiting s

let rewrite t ~words f =
  match t with
  | As_it_is s -> As_it_is (Packed.rewrite s ~words f)
  | Compressed s -> Compressed (Tree.rewrite s ~words f)
  | On_disk s -> On_disk (On_disk.rewrite s ~words f)
  | Shared s -> Shared (Shared_states.rewrite s ~words f)

let is_on_disk = function On_disk _ -> true | As_it_is _ | Compressed _ | Shared _ -> false

let spill t ~directory ~tick =
  match t with
  | As_it_is s -> On_disk (On_disk.of_packed s ~directory ~tick)
  | Compressed _ | On_disk _ | Shared _ -> invalid_arg "States.spill: not as they are"

let share t ~workers =
  match t with
  | As_it_is s -> Shared (Shared_states.of_packed s ~workers)
  | Compressed _ | On_disk _ | Shared _ -> invalid_arg "States.share: not as they are"

let is_shareable = function As_it_is _ -> true | Compressed _ | On_disk _ | Shared _ -> false
let shared = function Shared s -> Some s | As_it_is _ | Compressed _ | On_disk _ -> None

let iter t f =
  match t with
  | Shared s -> Shared_states.iter s f
  | As_it_is _ | Compressed _ | On_disk _ -> for i = 0 to count t - 1 do f i done

let close = function
  | On_disk s -> On_disk.close s
  | Shared s -> Shared_states.close s
  | As_it_is _ | Compressed _ -> ()
