open Core

let most_free = 1_000

let rec bits n = if n = 0 then 0 else 1 + bits (n / 2)

(* A string that is only copied costs little for each byte. *)
let size ~copied = function
  | String s -> if copied then String.length s / 100 else String.length s
  | x -> Option.value (Value.length x) ~default:0

let of_operation operation arguments =
  let elements ?(copied = false) xs = List.fold_left (fun n x -> n + min Value.most_items (size ~copied x)) 0 xs in
  let beyond n count = if n < most_free then 0 else count n in
  match operation, arguments with
  | (Call _ | Make_list | Make_map _ | Build _ | Add_setting _ | Make_branch), _
  | (Element | Method (("get" | "size" | "length" | "isEmpty" | "first" | "last" | "head"), _)), List _ :: _ -> 0
  | (Binary Add | Method ("addAll", _)), [ List _; List ys ] when Vector.length ys <> 1 ->
    beyond (elements arguments) (fun n -> n / 200)
  | (Binary (Append | Add) | Method (("add" | "push" | "leftShift" | "addAll"), _)), List _ :: ys ->
    beyond (elements ~copied:true ys) (fun n -> n / 200)
  | (Concatenate | Binary Add), xs -> beyond (elements ~copied:true xs) (fun n -> n / 200)
  | (Method (("sort" | "unique"), _) | Binary Subtract), xs -> beyond (elements xs) (fun n -> n * bits n / 10)
  | _, xs -> beyond (elements xs) (fun n -> n / 200)
