open Dolphin_runtime

(* Few events ever wait: a list, first one first. *)
type t = Platform.event list

let empty = []
let is_empty b = b = []

(* The ends of tasks keep their place behind the news that came before them. *)
let add (event : Platform.event) b =
  match event with
  | Vehicle state ->
    let rec without = function
      | Platform.Vehicle other :: rest when other.id = state.id -> rest
      | (Platform.Vehicle _ as other) :: rest -> other :: without rest
      | rest -> rest
    in
    List.rev (Platform.Vehicle state :: without (List.rev b))
  | Task_done _ | Task_failed _ | Timer _ | Quiet -> b @ [ event ]

let take = function
  | [] -> None
  | event :: rest -> Some (event, rest)

let without_task v =
  List.filter (function
      | Platform.Task_done w | Task_failed (w, _) -> w <> v
      | Vehicle _ | Timer _ | Quiet -> true)

let without_timer timer =
  List.filter (function
      | Platform.Timer other -> other <> timer
      | Vehicle _ | Task_done _ | Task_failed _ | Quiet -> true)
