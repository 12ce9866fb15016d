open Dolphin_semantics

type t = (float * Residual.timer) list  (* earliest first *)

let none = []

let of_list timers =
  let by_time (_, a) (_, b) = Float.compare a b in
  List.map (fun (timer, time) -> (time, timer)) (List.stable_sort by_time timers)

let cancel timer x = List.filter (fun (_, other) -> other <> timer) x

let set timer time x =
  let rec insert = function
    | (earlier, _) as other :: rest when earlier <= time -> other :: insert rest
    | rest -> (time, timer) :: rest
  in
  insert (cancel timer x)

let first = function (time, _) :: _ -> time | [] -> infinity

let expired ~now x =
  let due, later = List.partition (fun (time, _) -> time <= now) x in
  (List.map snd due, later)
