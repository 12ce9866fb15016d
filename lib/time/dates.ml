type 'a bound = { sooner : int; later : int; by : int; due_to : 'a option }

let at_most ?due_to later ~after by = { sooner = after; later; by; due_to }
let at_least ?due_to later ~after by = { sooner = later; later = after; by = -by; due_to }

exception Contradiction

(* A shortest way has no more than [n] steps, unless a way around is negative. *)
let latest_from from n bounds =
  let dates = Array.make (n + 1) None and last = Array.make (n + 1) None in
  dates.(from) <- Some 0;
  let relax changed bound =
    match dates.(bound.sooner), dates.(bound.later) with
    | Some sooner, known when Option.fold known ~none:true ~some:(fun known -> sooner + bound.by < known) ->
      dates.(bound.later) <- Some (sooner + bound.by);
      last.(bound.later) <- Some bound;
      true
    | (Some _ | None), _ -> changed
  in
  let rec rounds k =
    if List.fold_left relax false bounds then if k > n then raise Contradiction else rounds (k + 1) in
  rounds 0;
  (dates, last)

let latest n bounds = latest_from 0 n bounds

(* Backwards in time. *)
let earliest n bounds =
  let turned = List.map (fun b -> { b with sooner = b.later; later = b.sooner }) bounds in
  Array.map (Option.map Int.neg) (fst (latest n turned))

type span = Long of int * int | Short of int * int

let stretched n bounds spans =
  let stretch bounds span =
    let bound =
      match span with
      | Long (i, j) -> Option.map (fun by -> at_least j ~after:i by) (fst (latest_from i n bounds)).(j)
      | Short (i, j) -> Option.map (fun by -> at_most j ~after:i (-by)) (fst (latest_from j n bounds)).(i)
    in
    Option.to_list bound @ bounds
  in
  fst (latest n (List.fold_left stretch bounds spans))
