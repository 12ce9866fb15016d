open Dolphin_semantics

(* An inert sequence. The rest that it belongs to has a date of its own, when the last of it ends, and is over with move
   [over], if it is over. *)
type ending = { item : Inert.item; began : int; rest : int; is_last : bool; mutable over : int option }

(* The state of the unfolding after some moves. *)
type progress = {
  walk : Schedule.walk;
  bounds : Clocked.pending Dates.bound list;
  endings : ending list;
  rest : int option;  (* the date of the rest that has begun *)
  dates : int;  (* the number of the last date *)
}

let add_step system p k (step : Clocked.step) begun last =
  let bounds = Schedule.bounds (Zone_node.followed (Timed_system.places system)) p.walk k step in
  let rest, dates =
    match p.rest with
    | None when begun <> [] -> (Some (p.dates + 1), p.dates + 1)
    | rest -> (rest, p.dates)
  in
  let add rest (bounds, endings) (item : Inert.item) =
    let is_last = last = Some item.awaited in
    let after_all = Dates.at_least rest ~after:k item.least in
    let own = if is_last then [ after_all; Dates.at_most rest ~after:k item.most ] else [ after_all ] in
    (own @ bounds, { item; began = k; rest; is_last; over = None } :: endings)
  in
  let bounds, endings =
    match rest with
    | Some rest -> List.fold_left (add rest) (bounds @ p.bounds, p.endings) begun
    | None -> (bounds @ p.bounds, p.endings)
  in
  { walk = Schedule.walk p.walk k step; bounds; endings; rest; dates }

let add_rest p k steps later =
  let rest = Option.get p.rest in
  let order = Dates.at_least k ~after:(k - 1) 0 in
  let bounds =
    if later then [ order; Dates.at_least k ~after:rest 0; Dates.at_most k ~after:rest 0 ]
    else [ order; Dates.at_most k ~after:(k - 1) 0; Dates.at_least k ~after:rest 0 ]
  in
  List.iter (fun (e : ending) -> if e.over = None then e.over <- Some k) p.endings;
  { p with walk = List.fold_left (fun w step -> Schedule.walk w k step) p.walk steps; bounds = bounds @ p.bounds;
           rest = None }

let add system (k, p) : Timed_system.move -> _ = function
  | Step { step; begun; last } -> (k + 1, add_step system p k step begun last)
  | Rest { steps; later } -> (k + 1, add_rest p k steps later)

(* {1 In the order of dates} *)

(* The moves, which are numbered from 1 to [n], and the ends of inert parts, in the order in which they happen: those of
   one rest after all that is not later, and before what follows it. *)
type event = Followed of Timed_system.move | Part_ends of Inert.item * Inert.part

(* When the parts of a sequence end, as late or as early as its whole time [lasts] allows. *)
let ends (goal : Timed_system.goal) (item : Inert.item) lasts =
  let end_of (ends, least, most) (p : Inert.part) =
    let least = least + p.least and most = most + p.most in
    let over =
      match goal with
      | Latest -> min most (lasts - (item.least - least))
      | Earliest -> max least (lasts - (item.most - most))
    in
    ((p, over) :: ends, least, most)
  in
  let ends, _, _ = List.fold_left end_of ([], 0, 0) item.parts in
  List.rev ends

let in_order (goal : Timed_system.goal) moves n dates endings =
  let of_move k (move : Timed_system.move) = ((dates.(k + 1), 2 * (k + 1)), Followed move) in
  let of_ending e =
    let began = dates.(e.began) in
    let over = Option.map (fun k -> (dates.(k), (2 * k) - 1)) e.over in
    let lasts =
      match goal, over with
      | _, Some _ when e.is_last -> dates.(e.rest) - began
      | Earliest, _ -> e.item.least
      | Latest, Some (over, _) -> min (over - began) e.item.most
      | Latest, None -> e.item.most
    in
    let of_part (part, after) =
      let date = began + after in
      match over with
      | Some (_, place) -> Some ((date, place), Part_ends (e.item, part))
      | None when date <= dates.(n) -> Some ((date, 2 * n), Part_ends (e.item, part))
      | None -> None
    in
    List.filter_map of_part (ends goal e.item lasts)
  in
  let compare ((a : int * int), _) (b, _) = Stdlib.compare a b in
  List.stable_sort compare (List.mapi of_move moves @ List.concat_map of_ending endings)

(* {1 Again, step by step} *)

let same_event (a : Clocked.step) (b : Clocked.step) =
  Label.equal a.transition.label b.transition.label && Option.map fst a.due = Option.map fst b.due

(* The step of [state] that is [step], though inert sequences have gone on: each of [under_way] awaits its first event
   in [step], and another one, or none, in [state]. *)
let as_followed successors state under_way (step : Clocked.step) =
  let others = Inert.without (List.map fst under_way) step.next.configuration in
  let is_it (s : Clocked.step) =
    let here () = Inert.without (List.filter_map snd under_way) s.next.configuration in
    same_event s step && (others = None || Option.equal Configuration.equal others (here ()))
  in
  List.find_opt is_it (List.map (fun (s : Successors.successor) -> s.step) (Successors.all successors state))

(* The end of [part] in [state], and the steps that follow it. They come before all else, as nothing else is urgent
   where a part ends. *)
let end_of_part successors (state : Clocked.state) (part : Inert.part) =
  let is_end (s : Clocked.step) = Option.map fst s.due = Some part.event in
  let rec follow taken n (step : Clocked.step) =
    if n = 0 then Some (step :: taken)
    else
      match Successors.steps successors step.next with
      | next :: _ when next.urgent -> follow (step :: taken) (n - 1) next
      | _ -> None
  in
  Option.bind (List.find_opt is_end (Successors.steps successors state)) (follow [] part.follow)

(* The event that [item] awaits after [part]. *)
let awaited_after part (item : Inert.item) =
  let rec next = function
    | p :: rest when p == part -> (match rest with (q : Inert.part) :: _ -> Some q.event | [] -> None)
    | _ :: rest -> next rest
    | [] -> None
  in
  next item.parts

let steps successors start events =
  let rec go taken state under_way = function
    | [] -> Some (List.rev taken)
    | (_, event) :: rest -> (
        match event with
        | Followed (Rest _) -> go taken state [] rest
        | Followed (Step { step; _ }) -> (
            match as_followed successors state under_way step with
            | Some step -> go (step :: taken) step.next under_way rest
            | None -> None)
        | Part_ends (item, part) -> (
            match end_of_part successors state part with
            | Some (last :: _ as steps) ->
              let others = List.remove_assoc item.awaited under_way in
              go (steps @ taken) last.next ((item.awaited, awaited_after part item) :: others) rest
            | Some [] | None -> None))
  in
  go [] start [] events

(* Later than all that has a latest date. The rest after a state without one has none. *)
let far = max_int / 2

let in_dates system (goal : Timed_system.goal) moves =
  let start = Timed_system.start system and n = List.length moves in
  let p = { walk = Schedule.set_out start; bounds = []; endings = []; rest = None; dates = n } in
  let _, p = List.fold_left (add system) (1, p) moves in
  let dates =
    match goal with Latest -> fst (Dates.latest p.dates p.bounds) | Earliest -> Dates.earliest p.dates p.bounds in
  let dates = Array.map (Option.value ~default:far) dates in
  steps (Timed_system.successors system) start (in_order goal moves n dates (List.rev p.endings))

let run system goal arrivals =
  if Timed_system.is_reduced system then
    Option.bind (Represented.moves system arrivals) (in_dates system goal)
  else
    let steps (a : Timed_system.arrival) =
      match a.move with Step { step; _ } -> [ step ] | Rest { steps; _ } -> steps in
    Some (List.concat_map steps arrivals)
