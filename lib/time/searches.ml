module Limits = Dolphin_checker.Limits
module Search = Dolphin_checker.Breadth_first.Make (Timed_system)
open Timed_system

let search ?working ?enough ~started limits successors goal phase =
  let search = Search.create ~phase ~started limits (create ?working goal successors) in
  Search.run ?enough:(Option.map (fun enough () -> enough search) enough) search;
  search

let steps_along goal system moves =
  match Unfold.run system goal moves with
  | Some steps -> steps
  | None -> raise Broken

let best is_better system =
  let better found (_, (date, n)) =
    match found with Some (known, _) when not (is_better date known) -> found | Some _ | None -> Some (date, n)
  in
  List.fold_left better None (endings system)

let is_later a b =
  match a, b with Unbounded, At _ -> true | At m, At n -> m > n | (At _ | Unbounded), Unbounded -> false

let is_sooner a b = is_later b a

let dates system = List.map (fun (ending, (date, _)) -> (ending, date)) (endings system)
let earliest_dates = "earliest dates"

let early ~started limits successors : Timed.step list Early.t =
  let search = search ~started limits successors Earliest earliest_dates in
  let system = Search.system search in
  let steps_to (_, n) = steps_along Earliest system (path system n) in
  let missed (site, missed) = Option.map (fun (date, _) -> (site, date)) missed in
  { endings = dates system; tasks = tasks system;
    missed = List.filter_map missed (deadlines system);
    first = Option.map steps_to (best is_sooner system);
    stopped = Search.stopped search; states = Search.count search; depth = Search.depth search;
    bytes = Search.memory search }

(* {1 In two processes} *)

type sharing = { workers : int; fork_from : int }

let worth_a_fork = 300

(* What several processes take together, none of them knows. *)
let sharing ~workers ~fork_from (limits : Limits.t) =
  { workers = (if limits.max_memory = None then workers else 1); fork_from }

(* What the other process finds comes as plain data: configurations would come as copies, whose code and tasks are not
   those of the program here. *)
let both sharing ~working ~started limits successors =
  let options = Successors.options successors in
  let start = Timed.initial options in
  let choices early = Early.with_run (Choices.of_run options start) early in
  let work limits _ =
    match early ~started limits successors with
    | found -> Some (choices found)
    | exception Broken -> None
  in
  let beside = lazy (if sharing.workers > 1 then Beside.start ~workers:1 limits ~count:1 work else None) in
  let is_in_vain late =
    let beside = if Search.count late >= sharing.fork_from then Lazy.force beside else None in
    match Option.map Beside.so_far beside with
    | Some (_, Some _) | Some ([ (_, None) ], None) -> true
    | Some (_, None) | None -> false
  in
  let begun () = if Lazy.is_val beside then Lazy.force beside else None in
  let measures late : Limits.measures =
    let states = Search.count late in
    { states; expanded = states; depth = Search.depth late; used = Search.memory late; growth = 0 }
  in
  let found late =
    match begun () with
    | None -> early ~started limits successors
    | Some beside -> (
        match Beside.await beside ~started limits (measures late) earliest_dates with
        | [ (_, Some found) ], _ ->
          { (Early.with_run (Choices.run options start) found) with bytes = found.bytes + Search.memory late }
        | [ (_, None) ], _ -> raise Broken
        | _, bound -> Early.nothing (Option.get bound))
  in
  Fun.protect
    ~finally:(fun () -> Option.iter Beside.stop (begun ()))
    (fun () ->
       let late = search ~working ~enough:is_in_vain ~started limits successors Latest "latest dates" in
       (late, found late))

