open Dolphin_semantics

type t = Any | By of int

(* As [o], but [task] may take [more] milliseconds longer. *)
let lengthened (o : Clocked.options) (task : Timed_system.task) more =
  let bounds v place (p : Core.platform_task) : Bounds.t =
    match o.durations.task v place p with
    | Within { least; most } when v = task.vehicle && p.name = task.name && p.task_site = task.site ->
      Within { least; most = most + more }
    | bounds -> bounds
  in
  { o with durations = { o.durations with task = bounds } }

exception Not_found_out

(* No run with more is over earlier, as it has all runs with less. If the end is later by as much as the task is longer,
   [by_end] is the slack; else it is between [kept] and [later]. *)
let rec between late ~kept ~later ~by_end =
  if later - kept = 1 then kept
  else
    let is_between n = n > kept && n < later in
    let guesses = List.filter is_between [ by_end; by_end + 1; (kept + later) / 2 ] in
    let guess = List.hd guesses in
    match late guess with
    | None -> between late ~kept:guess ~later ~by_end
    | Some by -> between late ~kept ~later:guess ~by_end:(guess - by)

let of_task ~latest o n task =
  (* By how much the latest end is later if [task] may take [more]. *)
  let late more =
    match latest (lengthened o task more) with
    | Some (Timed_system.At m) -> if m > n then Some (m - n) else None
    | Some Unbounded -> Some max_int
    | None -> raise_notrace Not_found_out
  in
  (* A task that is still on after [n] makes the end later; if none is then, none is for longer. *)
  match late (n + 1) with
  | None -> Some Any
  | Some by -> Some (By (between late ~kept:0 ~later:(n + 1) ~by_end:(n + 1 - by)))
  | exception Not_found_out -> None
