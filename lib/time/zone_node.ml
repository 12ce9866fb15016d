open Dolphin_semantics
module Limits = Dolphin_checker.Limits

(* Of the inert ends to come: whether the last one is decided. *)
type rest = No_rest | Unsaid | Said

(* A step, with the inert items after it, and those of them that have begun with it. *)
type arrow = {
  step : Clocked.step;
  inert : Inert.item list;
  begun : Inert.item list;
  spelled : Canonical_state.execution -> Canonical_state.spelled;
}

(* A state without its clocks, with the data that follow from it alone, and the numbers of the states with clocks. *)
type t = {
  state : Clocked.state;
  execution : Canonical_state.execution option;  (* if states that are alike are kept once *)
  items : Clocked.item list;  (* then what is awaited, in the order of the forms of states that are alike *)
  rest : rest;
  inert : Inert.item list;
  follows : (arrow list * (Clocked.item * int) list) Lazy.t;  (* and until when time may pass *)
  clocks : (Clocked.item * int) list;  (* waits that began at one time share one clock *)
  rest_clock : int option;  (* how long ago the last of the inert ends was: less than 0 as it is to come *)
  mutable here : int list;
  mutable wider : (t * (Zone.t -> Zone.t)) list;
  mutable narrower : (t * (Zone.t -> Zone.t)) list;
}

type key = Exactly of Clocked.state | Alike of int

module Table = Hashtbl.Make (struct
    type t = key * rest

    let equal (key, rest) (key', rest') =
      rest = rest'
      && match key, key' with
      | Exactly s, Exactly s' -> Clocked.equal s s'
      | Alike form, Alike form' -> Int.equal form form'
      | (Exactly _ | Alike _), _ -> false

    let hash (key, rest) =
      Hashtbl.hash rest + match key with Exactly s -> Clocked.hash s | Alike form -> form
  end)

type places = {
  successors : Successors.t;
  filled : Zone.t -> Zone.t;
  note : Clocked.state -> unit;
  table : t list Table.t;  (* those of one state differ in the waits that share a clock *)
}

exception Broken

let places successors ~filled ~note = { successors; filled; note; table = Table.create 1_000 }
let options t = Successors.options t.successors
let likeness t = Successors.likeness t.successors
let successors t = t.successors
let add place number = place.here <- number :: place.here
let remove place number = place.here <- List.filter (( <> ) number) place.here

let with_clocks (s : Clocked.state) inert =
  let has_clock (p : Clocked.pending) =
    match p.bounds with Within _ -> not (Inert.is_awaited inert p.item) | Some_time | Never -> false in
  List.map (fun (p : Clocked.pending) -> p.item) (List.filter has_clock s.pending)

let course_item t = Option.map (fun c -> Clocked.Course (Course.vehicle c)) (Successors.course t.successors)

let fresh t before (step : Clocked.step) =
  match Successors.course t.successors with
  | Some c when Course.turns c before step -> Clocked.Course (Course.vehicle c) :: step.fresh
  | Some _ | None -> step.fresh
let is_among items (i : Inert.item) = Inert.is_awaited items i.awaited

(* An inert item stays so until all is over, and is so from its beginning. *)
let arrow inert_before { Successors.step; inert; spelled } =
  let inert = Lazy.force inert in
  let begun = List.filter (fun i -> not (is_among inert_before i)) inert in
  let has_begun (i : Inert.item) = List.mem i.awaited step.fresh in
  if List.for_all (is_among inert) inert_before && List.for_all has_begun begun then { step; inert; begun; spelled }
  else raise Broken

(* Of the arrows that an automorphism of the state with its clocks maps to each other, one is enough. *)
let different e before clocks arrows =
  let seen = Hashtbl.create 16 in
  let is_new { step; inert = _; begun; spelled } =
    match step.next.configuration.control with
    | Script _ | Waiting _ | Ended _ -> true
    | Executing _ ->
      let clock item = Option.value (List.assoc_opt item clocks) ~default:0 in
      let color item = if List.mem item step.fresh then -1 else clock item in
      let form = Canonical_state.form ~color ~colored:true (spelled e) in
      let orbit = Canonical_state.orbit e in
      let part (p : Inert.part) = (p.least, p.most, Option.map orbit (Happening.task_of_part p)) in
      let parts (i : Inert.item) = List.map part i.parts in
      let due = Option.map (fun (item, bounds) -> (clock item, bounds)) step.due in
      let happens = List.map (fun (moment, task) -> (moment, orbit task)) (Happening.tasks before step) in
      let what = (step.transition.rules, List.sort Stdlib.compare happens, Happening.missed before step) in
      let key = (due, step.urgent, what, List.sort Stdlib.compare (List.map parts begun), form.number) in
      let is_new = not (Hashtbl.mem seen key) in
      Hashtbl.replace seen key ();
      is_new
  in
  List.filter is_new arrows

let arrows_of t state inert =
  let is_followed (s : Successors.successor) =
    match s.step.due with
    | Some (item, _) -> not (Inert.is_awaited inert item)
    | None -> true
  in
  List.map (arrow inert) (List.filter is_followed (Successors.followed t.successors state))

let find_arrows t state execution inert clocks =
  let all = arrows_of t state inert in
  let limits = Clocked.holds_up (List.map (fun arrow -> arrow.step) all) in
  match execution, all with
  | Some e, _ :: _ :: _ -> (different e state clocks all, limits)
  | _, _ -> (all, limits)

let followed t s = List.map (fun arrow -> arrow.step) (arrows_of t s (Successors.inert t.successors s))

(* The zones of [p] as those of [q], a place of the same state, if waits that share a clock in [q] do so in [p]. *)
let seen_from p q =
  let from = Array.make (List.fold_left (fun last (_, clock) -> max last clock) 0 q.clocks) None in
  let note is_function (_, mine) (_, clock) =
    match from.(clock - 1) with
    | Some other -> is_function && Int.equal mine other
    | None -> from.(clock - 1) <- Some mine; is_function
  in
  if List.fold_left2 note true p.clocks q.clocks then
    let rest = match p.rest_clock with Some _ as rest -> [| rest |] | None -> [||] in
    Some (Zone.rearranged (Array.append from rest))
  else None

let relate p q =
  let narrow p q seen =
    p.wider <- (q, seen) :: p.wider;
    q.narrower <- (p, seen) :: q.narrower
  in
  Option.iter (narrow p q) (seen_from p q);
  Option.iter (narrow q p) (seen_from q p)

(* [clocks] is in an order that depends on [key]. *)
let find t key state execution items inert rest clocks =
  let key = (key, rest) and numbers = List.map snd clocks in
  let others = Option.value (Table.find_opt t.table key) ~default:[] in
  match List.find_opt (fun p -> List.map snd p.clocks = numbers) others with
  | Some place -> place
  | None ->
    t.note state;
    let last = List.fold_left max 0 numbers in
    let rest_clock = if rest = No_rest then None else Some (last + 1) in
    let follows = lazy (find_arrows t state execution inert clocks) in
    let place =
      { state; execution; items; rest; inert; follows; clocks; rest_clock; here = []; wider = []; narrower = [] } in
    Table.replace t.table key (place :: others);
    List.iter (relate place) others;
    place

let unsettled t (fault : Fault.t) =
  let at = Format.pp_print_option (fun ppf -> Format.fprintf ppf "%a: " Dolphin_syntax.Location.pp) in
  let why = Format.asprintf "%a%s" at (Fault.location (options t).program fault) fault.message in
  raise (Limits.Stop (Unsettled why))

let undated =
  "now() is used other than in comparisons with constants such as now() < 20.min: its effect on time is unknown here"

let without_time_of_day =
  "now() or timeOfDay() is used other than in comparisons with constants, or the fleet does not have the date at which \
   the run begins: the effect of the date on time is unknown here"

let check_dates t =
  let message = if (options t).program.reads_time_of_day then without_time_of_day else undated in
  Result.iter_error (fun site -> unsettled t (Fault.make site message)) (options t).dates

let follow t place =
  match Lazy.force place.follows with
  | found -> found
  | exception Dolphin_environment.Environment.Unclear fault -> unsettled t fault

let arrows t place = fst (follow t place)
let steps t place = List.map (fun arrow -> arrow.step) (arrows t place)

(* {1 Zones} *)

let ( let* ) = Option.bind

(* As long as no step is urgent, time passes until something has to happen. *)
let settled t place zone =
  let steps = steps t place and filled = t.filled in
  if steps = [] || List.exists (fun (s : Clocked.step) -> s.urgent) steps then Some (filled zone)
  else
    let limit zone (item, most) =
      match List.assoc_opt item place.clocks with
      | Some clock -> Option.bind zone (Zone.at_most clock most)
      | None -> zone
    in
    Option.map filled (List.fold_left limit (Some (Zone.delay zone)) (snd (follow t place)))

(* Those valuations of [zone] in which [step] may be taken. *)
let enabling place zone (step : Clocked.step) =
  match step.due with
  | Some (item, Within { least; most }) -> (
      match List.assoc_opt item place.clocks with
      | Some clock ->
        let* zone = Zone.at_least clock least zone in
        Zone.at_most clock most zone
      | None -> Some zone)
  | Some (_, (Some_time | Never)) | None -> Some zone

(* Numbers from 1 for the items of [xs], in the order of occurrence. *)
let numbered xs =
  let number (known, numbers) x =
    match List.assoc_opt x known with
    | Some n -> (known, n :: numbers)
    | None -> let n = List.length known + 1 in ((x, n) :: known, n :: numbers)
  in
  let known, numbers = List.fold_left number ([], []) xs in
  (List.rev_map fst known, List.rev numbers)

(* The place of [state] by the decision on the rest, if there is one, with the value of [zone] there, where [fresh]
   begins, and the clocks were those of [clocks] and [rest_clock] before; and the awaited events of [state], in the
   order of its form. *)
let reached t ~clocks ~rest_clock ~fresh ~has_rest spelled state inert zone =
  let awaited = with_clocks state inert and course = Option.to_list (course_item t) in
  let with_clocks = awaited @ course in
  let origin item = if List.mem item fresh then None else List.assoc_opt item clocks in
  let origins, numbers = numbered (List.map origin with_clocks) in
  let zone = Zone.rearranged (Array.of_list (origins @ if has_rest then [ rest_clock ] else [])) zone in
  let rec first clock k = if k = clock || Zone.are_equal k clock zone then k else first clock (k + 1) in
  let clocks = List.combine with_clocks (List.map (fun clock -> first clock 1) numbers) in
  let key, items =
    match spelled with
    | Some spelled ->
      let ranks = Zone.ranks zone in
      let color item = match List.assoc_opt item clocks with Some clock -> 1 + ranks.(clock - 1) | None -> 0 in
      let { Canonical_state.number; items } = Canonical_state.form ~color ~colored:false spelled in
      (Alike number, items)
    | None -> (Exactly state, awaited)
  in
  let with_clock item = Option.map (fun clock -> (item, clock)) (List.assoc_opt item clocks) in
  let in_order = List.filter_map with_clock (items @ course) in
  let firsts, numbers = numbered (List.map snd in_order) in
  let clocks = List.map2 (fun (item, _) n -> (item, n)) in_order numbers in
  let last = if has_rest then [ Some (List.length origins + 1) ] else [] in
  let zone = Zone.rearranged (Array.of_list (List.map Option.some firsts @ last)) zone in
  let execution = Option.map Canonical_state.execution_of spelled in
  fun rest ->
    let place = find t key state execution items inert rest clocks in
    match rest_clock, place.rest_clock with
    | None, Some clock -> (place, items, Zone.freed clock zone)
    | (None | Some _), _ -> (place, items, zone)

(* {1 The rest} *)

(* Those valuations in which the last end to come is one of [begun], as [last] has it, or of those before. *)
let with_begun place begun last zone =
  match place.rest_clock with
  | None -> Some zone
  | Some clock ->
    let bound zone (i : Inert.item) =
      let* zone = Option.bind zone (Zone.at_most clock (-i.least)) in
      if last = Some i.awaited then Zone.at_least clock (-i.most) zone else Some zone
    in
    List.fold_left bound (Some zone) begun

(* Those of the beginning ones that may be the last, and the decision after it. *)
let lasts place begun =
  match place.rest, begun with
  | rest, [] -> [ (None, rest) ]
  | Said, _ -> [ (None, Said) ]
  | (No_rest | Unsaid), _ -> (None, Unsaid) :: List.map (fun (i : Inert.item) -> (Some i.awaited, Said)) begun

(* All that is inert ends, where nothing else is left: any order will do. *)
let ends_of_rest t state =
  let rec go steps n (state : Clocked.state) =
    match Successors.steps t.successors state with
    | step :: _ when n > 0 -> go (step :: steps) (n - 1) step.next
    | _ -> List.rev steps
  in
  let inert = Successors.inert t.successors state in
  go [] (List.fold_left (fun n i -> n + Inert.steps i) 0 inert) state

(* When all that is inert is over in a state with nothing else left: now, or when the last of it ends. *)
let ends_now clock zone = Option.map (fun zone -> (zone, false)) (Zone.at_least clock 0 zone)

let ends_later clock zone =
  let* zone = Zone.at_most clock 0 zone in
  let* zone = Zone.at_least clock 0 (Zone.delay zone) in
  Option.map (fun zone -> (zone, true)) (Zone.at_most clock 0 zone)

(* {1 Executions} *)

(* The rest of N when a task is over must be the same in all states that are alike. *)
let check_left t before (next : Clocked.state) =
  match likeness t, before.execution, next.configuration.control with
  | Some likeness, Some e, (Script _ | Waiting _) when not (Canonical_state.leaves_alike likeness e next) ->
    raise Broken
  | _, _, _ -> ()

let execution_after t before (next : Clocked.state) =
  match likeness t, before.state.configuration.control, next.configuration.control with
  | Some _, Executing _, Executing _ -> before.execution
  | Some likeness, _, Executing _ -> 
    Canonical_state.execution ~tick:(Successors.tick (successors t)) likeness next
  | _, _, _ -> check_left t before next; None
