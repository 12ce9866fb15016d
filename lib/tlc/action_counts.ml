type count = { action : string; found : int; taken : int }

(* ["<Take_START line 822, col 1 to line 822, col 10 of module Dolphin>: 3:5"] *)
let count text =
  match Scanf.sscanf text "<%s@ %_[^>]>: %d:%d" (fun action found taken -> { action; found; taken }) with
  | c -> Some c
  | exception (Scanf.Scan_failure _ | Failure _ | End_of_file) -> None

(* TLC's class EC has 2772 for an action, 2773 for an initial predicate. *)
let of_message : Message.t -> count option = function
  | Message { code = 2772; text; _ } -> count text
  | Message _ | Line _ -> None
