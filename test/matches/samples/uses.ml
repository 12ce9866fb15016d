(* Listed: all three are named. *)

let rec size : Core.task -> int = function Idle | Platform _ -> 1 | Sequence (a, b) -> size a + size b

let same (a : Core.task) (b : Core.task) =
  match a, b with
  | Idle, Idle -> true
  | Platform p, Platform p' -> String.equal p p'
  | Sequence (a, _), Sequence (a', _) -> a == a'
  | (Idle | Platform _ | Sequence _), _ -> false

(* Not listed. *)

let is_idle : Core.task -> bool = function Idle -> true | _ -> false
let both (a : Core.task) (b : Core.task) = match a, b with Idle, Platform _ -> true | _, Sequence _ -> true | _ -> false
