open Dolphin_semantics
module System = Dolphin_checker.System
module Limits = Dolphin_checker.Limits

type goal = Latest | Earliest
type via = unit
type property = unit
type date = At of int | Unbounded
type moment = Starts | Ends | Fails | Stopped
type task = { name : string; vehicle : Core.vehicle; site : Core.site }
type ending = Completed | Halted | Failed | Interrupted
type cycle = { from : int; last : int; back : Timed.step; in_no_time : bool }

(* A state without its clocks, with what follows from it alone, and the numbers of the states with clocks. *)
type place = {
  state : Timed.state;
  steps : Timed.step list Lazy.t;
  clocks : (Timed.item * int) list;
  mutable here : int list;
}

type node = { place : place; zone : Zone.t; parent : int; step : Timed.step option }

module Table = Hashtbl.Make (struct
    type t = Timed.state

    let equal = Timed.equal
    let hash = Timed.hash
  end)

type t = {
  goal : goal;
  options : Timed.options;
  places : place Table.t;
  mutable nodes : node array;
  mutable count : int;
  mutable reserved : int;
  moments : (task * moment, date) Hashtbl.t;
  mutable tasks : task list;  (* latest first *)
  mutable endings : (ending * (date * int)) list;
  mutable cycle : cycle option;
  mutable stuck : int option;
  mutable unknown : Timed.pending list;
  mutable deadlines : Core.site list;  (* of [within], latest first *)
  missed : (Core.site, date * int * Timed.step) Hashtbl.t;
}

(* {1 Places} *)

let clocks (s : Timed.state) =
  let has_clock (p : Timed.pending) = match p.bounds with Within _ -> true | Some_time | Never -> false in
  List.mapi (fun i (p : Timed.pending) -> (p.item, i + 1)) (List.filter has_clock s.pending)

(* The [within] that have begun in a state, each with its timer. *)
let deadlines_of (s : Timed.state) =
  let deadline found (r : Residual.t) =
    match r with During { on_cut = Fails site; timer; started = true; _ } -> (timer, site) :: found | _ -> found in
  match s.configuration.control with
  | Executing (_, r) -> Residual.fold_active deadline [] r
  | Script _ | Waiting _ | Ended _ -> []

let place t state =
  match Table.find_opt t.places state with
  | Some place -> place
  | None ->
    let note (_, site) = if not (List.mem site t.deadlines) then t.deadlines <- site :: t.deadlines in
    List.iter note (deadlines_of state);
    let place = { state; steps = lazy (Timed.steps t.options state); clocks = clocks state; here = [] } in
    Table.add t.places state place;
    place

let steps t place =
  match Lazy.force place.steps with
  | steps -> steps
  | exception Dolphin_environment.Environment.Unclear fault ->
    let at = Format.pp_print_option (fun ppf -> Format.fprintf ppf "%a: " Dolphin_syntax.Location.pp) in
    let why = Format.asprintf "%a%s" at (Fault.location t.options.program fault) fault.message in
    raise (Limits.Stop (Unsettled why))

(* {1 Zones} *)

let ( let* ) = Option.bind

(* As long as no step is urgent, time passes until something has to happen. *)
let settled t place zone =
  let steps = steps t place in
  let filled = match t.goal with Latest -> Zone.reaching_down | Earliest -> Zone.reaching_up in
  if steps = [] || List.exists (fun (s : Timed.step) -> s.urgent) steps then Some (filled zone)
  else
    let limit zone (item, most) =
      match List.assoc_opt item place.clocks with
      | Some clock -> Option.bind zone (Zone.at_most clock most)
      | None -> zone
    in
    Option.map filled (List.fold_left limit (Some (Zone.delay zone)) (Timed.holds_up steps))

(* Those valuations of [zone] in which [step] may be taken. *)
let enabling place zone (step : Timed.step) =
  match step.due with
  | Some (item, Within { least; most }) -> (
      match List.assoc_opt item place.clocks with
      | Some clock ->
        let* zone = Zone.at_least clock least zone in
        Zone.at_most clock most zone
      | None -> Some zone)
  | Some (_, (Some_time | Never)) | None -> Some zone

let rearranged before after (step : Timed.step) zone =
  let from (item, _) = if List.mem item step.fresh then None else List.assoc_opt item before.clocks in
  Zone.rearranged (Array.of_list (List.map from after.clocks)) zone

(* {1 What is found} *)

let date t zone =
  match t.goal with
  | Earliest -> At (Zone.earliest_date zone)
  | Latest -> Option.fold ~none:Unbounded ~some:(fun n -> At n) (Zone.latest_date zone)

let is_better t a b =
  match t.goal, a, b with
  | Latest, Unbounded, At _ -> true
  | Latest, At m, At n -> m > n
  | Earliest, At m, At n -> m < n
  | (Latest | Earliest), _, _ -> false

let note_task t date task moment =
  match Hashtbl.find_opt t.moments (task, moment) with
  | Some known when not (is_better t date known) -> ()
  | Some _ -> Hashtbl.replace t.moments (task, moment) date
  | None ->
    if not (List.mem task t.tasks) then t.tasks <- task :: t.tasks;
    Hashtbl.replace t.moments (task, moment) date

let note_unknown t (s : Timed.state) =
  let note (p : Timed.pending) =
    let same (q : Timed.pending) = q.item = p.item && Option.equal ( == ) q.task p.task in
    if p.bounds = Some_time && not (List.exists same t.unknown) then t.unknown <- p :: t.unknown
  in
  List.iter note s.pending

let note_step t zone (before : Timed.state) (step : Timed.step) =
  let tr = step.transition in
  let running = before.configuration.shared.allocation in
  let task v (p : Core.platform_task) = { name = p.name; vehicle = v; site = p.task_site } in
  let note v moment =
    Option.iter (fun p -> note_task t (date t zone) (task v p) moment) (Vehicle_map.find_opt v running)
  in
  (match tr.label with Done (v, _) -> note v Ends | Fail (v, _, _) -> note v Fails | _ -> ());
  let carry : Effect.t -> unit = function
    | Start (v, p) -> note_task t (date t zone) (task v p) Starts
    | Stop v -> note v Stopped
    | _ -> ()
  in
  List.iter carry tr.effects

(* [step] is taken from state [n]. *)
let note_missed t n zone (before : Timed.state) (step : Timed.step) =
  match step.due with
  | Some (Timer timer, _) when List.mem Rule.Within_cut step.transition.rules ->
    let date = date t zone in
    let note site =
      match Hashtbl.find_opt t.missed site with
      | Some (known, _, _) when not (is_better t date known) -> ()
      | Some _ | None -> Hashtbl.replace t.missed site (date, n, step)
    in
    Option.iter note (List.assoc_opt timer (deadlines_of before))
  | Some _ | None -> ()

let ending : Configuration.ending -> ending = function
  | Completed -> Completed
  | Halted _ -> Halted
  | Failed _ -> Failed
  | Interrupted -> Interrupted

let note_end t number node =
  match node.place.state.configuration.control with
  | Ended e ->
    let e = ending e and date = date t node.zone in
    (match List.assoc_opt e t.endings with
     | Some (known, _) when not (is_better t date known) -> ()
     | Some _ | None -> t.endings <- (e, (date, number)) :: List.remove_assoc e t.endings)
  | Script _ | Waiting _ | Executing _ -> ()

(* {1 Numbers} *)

let add t node =
  if t.count = Array.length t.nodes then begin
    let nodes = Array.make (max 1_024 (2 * t.count)) node in
    Array.blit t.nodes 0 nodes 0 t.count;
    t.nodes <- nodes
  end;
  let number = t.count in
  t.nodes.(number) <- node;
  t.count <- number + 1;
  node.place.here <- number :: node.place.here;
  note_end t number node;
  number

let rec is_before t m n = m = n || (n > m && is_before t m t.nodes.(n).parent)

(* A step from state [n] leads back to where an earlier state of the run to it was. *)
let find_cycle t n step place zone =
  let comes_back m =
    let by = Zone.delayed t.nodes.(m).zone zone in
    if by >= 0 && is_before t m n then Some (m, by) else None
  in
  match t.goal with
  | Earliest -> None
  | Latest ->
    let found = List.find_map comes_back place.here in
    let note (m, by) =
      let known = match t.cycle with Some c -> not c.in_no_time || by = 0 | None -> false in
      if not known then t.cycle <- Some { from = m; last = n; back = step; in_no_time = by = 0 }
    in
    Option.iter note found;
    found

(* The number of the state that stands for [place] with [zone], to which [step] leads from state [n]. *)
let arrive t n step place zone =
  let including () = List.find_opt (fun m -> Zone.subset zone t.nodes.(m).zone) place.here in
  match find_cycle t n step place zone with
  | Some (m, by) when by > 0 && Zone.latest_date t.nodes.(m).zone <> None ->
    (* Once more and once more: at any later date. *)
    let zone = Zone.at_any_date t.nodes.(m).zone in
    (match List.find_opt (fun k -> Zone.subset zone t.nodes.(k).zone) place.here with
     | Some k -> k
     | None -> add t { place; zone; parent = n; step = Some step })
  | Some _ | None -> (
      match including () with
      | Some m -> m
      | None -> add t { place; zone; parent = n; step = Some step })

(* {1 The system} *)

exception Outgrown

let words _ = 1
let number t word = word lsr t.reserved

let widen t ~reserved =
  let before = t.reserved in
  t.reserved <- reserved;
  fun old fresh -> fresh.(0) <- (old.(0) lsr before) lsl reserved

let create goal options =
  { goal; options; places = Table.create 1_000; nodes = [||]; count = 0; reserved = 0; moments = Hashtbl.create 100;
    tasks = []; endings = []; cycle = None; stuck = None; unknown = []; deadlines = [];
    missed = Hashtbl.create 8 }

let visit t (v : via System.visitor) n = v.visit [| n lsl t.reserved |] 0 ()

let initial t v =
  if t.count = 0 then begin
    let place = place t (Timed.initial t.options) in
    match settled t place Zone.(rearranged (Array.make (List.length place.clocks) None) start) with
    | Some zone -> ignore (add t { place; zone; parent = -1; step = None })
    | None -> assert false  (* nothing is over at the start *)
  end;
  visit t v 0

let expand t key (v : via System.visitor) =
  let n = number t key.(0) in
  let { place = before; zone; _ } = t.nodes.(n) in
  let steps = steps t before in
  note_unknown t before.state;
  if t.stuck = None && Timed.is_stuck t.options before.state steps then t.stuck <- Some n;
  let take taken (step : Timed.step) =
    v.tick ();
    match enabling before zone step with
    | None -> taken
    | Some zone -> (
        note_step t zone before.state step;
        note_missed t n zone before.state step;
        let place = place t step.next in
        match settled t place (rearranged before place step zone) with
        | Some zone -> visit t v (arrive t n step place zone); taken + 1
        | None -> taken)
  in
  List.fold_left take 0 steps

let broken _ _ = None
let is_end _ _ = true
let may_cycle _ = false
let is_anchor _ _ = true
let valuation _ _ _ = 0

(* {1 Answers} *)

let tasks t =
  let moments task =
    let find moment = Option.map (fun date -> (moment, date)) (Hashtbl.find_opt t.moments (task, moment)) in
    (task, List.filter_map find [ Starts; Ends; Fails; Stopped ])
  in
  List.rev_map moments t.tasks

let endings t = List.sort Stdlib.compare t.endings
let cycle t = t.cycle
let stuck t = t.stuck
let unknown t = List.rev t.unknown

let run t n =
  let rec back steps n =
    match t.nodes.(n) with { step = Some step; parent; _ } -> back (step :: steps) parent | { step = None; _ } -> steps
  in
  back [] n

let deadlines t =
  let missed site =
    let run (date, n, step) = (date, run t n @ [ step ]) in
    (site, Option.map run (Hashtbl.find_opt t.missed site))
  in
  List.rev_map missed t.deadlines

let start t = t.nodes.(0).place.state
