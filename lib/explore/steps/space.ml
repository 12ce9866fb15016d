open Dolphin_semantics
open Dolphin_environment
open Component
open Expansion

type t = Expansion.t

(* {1 States} *)

let state t i = Encoding.read t.words (load t i)

let shared t i =
  let first = (load t i).(0) in
  if Layouts.number t.shapes first = 0 then -1 else Layouts.shared t.shapes first

let choices t outside c =
  match t.vehicles with
  | Some vehicles -> Canonical_vehicles.choices vehicles outside c
  | None -> Environment.choices t.options t.program t.world outside c

let canonical t c outside =
  match t.vehicles with Some vehicles -> Canonical_vehicles.canonical vehicles c outside | None -> (c, outside)

let has_vehicle_symmetry t = t.vehicles <> None

(* {1 Where nothing executes} *)

let expand_whole t i number =
  let c, outside = Encoding.value t.words number in
  let choices = choices t outside c in
  let go ((next : Transition.t), outside) =
    Coverage.transition (Components.coverage t.parts) c next;
    Script_graph.follows t.script number (Encoding.write t.words t.other next.rules next.next outside);
    Option.iter (fun w -> t.action <- Valuation.action (Product.letters w) next) t.watch;
    visit t t.other i
  in
  List.iter go choices;
  if not (Environment.goes_on choices) then begin
    note_stays t i;
    match c.control with
    | Ended _ -> ()
    | Script _ | Waiting _ | Executing _ -> note_broken t No_deadlock i
  end;
  List.length choices

(* {1 All steps} *)

(* As constants of this module they cost nothing. *)
let unknown = Memoised_steps.unknown
let special = Memoised_steps.special

(* For the watch: [step] is possible, and not [special]. *)
let note_action t step shared =
  match step.dependence with
  | Guarded guard -> t.action <- guard.actions.(shared)
  | Free -> t.action <- (if step.free_action >= 0 then step.free_action else Memoised_steps.action t.cases step shared)
  | By_case -> ()

let take_all t (s : Layout.t) place steps shared i =
  let taken = ref 0 and is_watched = Option.is_some t.watch in
  for k = 0 to Array.length steps - 1 do
    let step = Array.unsafe_get steps k in
    let shared' =
      match step.dependence with
      | Free -> shared
      | By_case -> special
      | Guarded guard ->
        let known = if shared < Array.length guard.results then Array.unsafe_get guard.results shared else unknown in
        if known <> unknown then known
        else begin
          let result = Memoised_steps.guarded t.cases step guard shared in
          Encoding.check_fit t.words;
          result
        end
    in
    if shared' >= 0 then begin
      incr taken;
      if is_watched then note_action t step shared;
      go_to t s place step.target shared shared' i
    end
    else if shared' = special then taken := !taken + go_by_case t s place step shared i
  done;
  !taken

let part_at t (s : Layout.t) position =
  let part = Encoding.part s t.key position in
  if Array.length part.steps = 0 then begin
    Components.reach t.parts part;
    Encoding.check_fit t.words
  end;
  part

let cuts t (nest : Layout.place) =
  match nest.inside with
  | None -> [||]
  | Some { cuts = Some cuts; _ } -> cuts
  | Some inside ->
    let cuts = Components.cuts t.parts inside in
    Encoding.check_fit t.words;
    cuts

let expand_all t (s : Layout.t) shared i =
  let taken = ref 0 in
  for position = 0 to Array.length s.families - 1 do
    let part = part_at t s position in
    taken := !taken + take_all t s (Array.unsafe_get s.leaves position) part.steps shared i
  done;
  for n = 0 to Array.length s.nests - 1 do
    let nest = s.nests.(n) in
    taken := !taken + take_all t s nest (cuts t nest) shared i
  done;
  !taken

(* {1 Steps that are enough} *)

let local_status t step shared : Stubborn.status =
  let move level target : Stubborn.move =
    { level; over = (match target with Gone -> true | Stays _ | Becomes _ | Ends _ -> false) }
  in
  let of_case case = move case.level case.result in
  let by_case () : Stubborn.status =
    match Memoised_steps.case t.cases step shared with
    | { possible = false; _ } -> Impossible
    | { certain = true; _ } as case -> if ends_run case then Ends else Moves (of_case case)
    | { certain = false; _ } as case ->
      let ends, moves = List.partition ends_run (case :: case.others) in
      Depends { moves = List.map of_case moves; ends = ends <> [] }
  in
  match step.dependence with
  | Free -> Moves (move 0 step.target)
  | By_case -> by_case ()
  | Guarded guard ->
    let result = Memoised_steps.guarded t.cases step guard shared in
    if result >= 0 then Moves (move 0 step.target) else if result = special then by_case () else Impossible

let take_step t s place step shared i =
  match step.dependence with
  | Free -> go_to t s place step.target shared shared i; 1
  | Guarded guard when Memoised_steps.guarded t.cases step guard shared >= 0 ->
    go_to t s place step.target shared (Memoised_steps.guarded t.cases step guard shared) i;
    1
  | Guarded _ | By_case -> go_by_case t s place step shared i

(* Parts and nests, with their steps. *)
let components t (s : Layout.t) =
  let part position place =
    let part = part_at t s position in
    ({ Stubborn.place; analysis = Components.components t.parts part }, part.steps)
  in
  let nest (place : Layout.place) =
    let steps = cuts t place in
    let of_path path = ({ Stubborn.place; analysis = Components.cuts_components t.parts path }, steps) in
    if Array.length steps = 0 then None else Option.map of_path place.inside
  in
  Array.append (Array.mapi part s.leaves) (Array.of_list (List.filter_map nest (Array.to_list s.nests)))

(* As [expand_all]. Which steps are enough depends on nothing but the configuration. *)
let expand_some t (s : Layout.t) shared i =
  let components = components t s in
  let status x k = local_status t (snd components.(x)).(k) shared in
  let choice = Stubborn.choose (Array.map fst components) status in
  let taken = ref 0 in
  let go x ({ Stubborn.place; analysis }, steps) =
    let take k step =
      let is_chosen = match choice with None -> true | Some chosen -> chosen x k in
      if is_chosen || analysis.ends.(k) then begin
        let status = status x k in
        Encoding.check_fit t.words;
        match status with
        | Impossible -> ()
        | Moves _ when not is_chosen -> ()
        | Depends _ when not is_chosen -> taken := !taken + go_to_ends t s place step shared i
        | Moves _ | Ends | Depends _ -> taken := !taken + take_step t s place step shared i
      end
    in
    Array.iteri take steps
  in
  Array.iteri go components;
  Encoding.check_fit t.words;
  !taken

(* {1 Expanding} *)

let expand_executing t i number =
  let s = Layouts.shape t.shapes number and shared = Layouts.shared t.shapes t.key.(0) in
  let taken =
    if Reduction.by_order t.reduction then expand_some t s shared i else expand_all t s shared i
  in
  if taken = 0 then begin
    note_stays t i;
    note_broken t No_deadlock i
  end;
  taken + interrupt t s shared i

let rec expand t i =
  match
    Dolphin_checker.States.load t.states i t.key;
    let number = Layouts.number t.shapes t.key.(0) in
    if Option.is_some t.watch then t.watched <- Layouts.watched t.shapes t.key.(0);
    if number = 0 then expand_whole t i (Layouts.shared t.shapes t.key.(0)) else expand_executing t i number
  with
  | taken ->
    if not t.gathering then t.transitions <- t.transitions + taken
  | exception Layouts.Outgrown ->
    flush t;
    (* Once this has begun it must not fail. *)
    t.reserve (Dolphin_checker.States.bytes_to_rewrite t.states ~words:(Dolphin_checker.States.words t.states + 1));
    repack t;
    expand t i

let gather t i =
  t.gathering <- true;
  t.gathered <- [];
  expand t i;
  t.gathering <- false;
  t.gathered

let steps t i = List.rev_map (fun arrival -> (arrival.into, arrival.by)) (gather t i)
let arrivals t i = List.rev_map (fun arrival -> (arrival.into, arrival.letter)) (gather t i)
let successors t i = List.rev_map (fun arrival -> arrival.into) (gather t i)

type view = Exact of Configuration.t * Environment.t | Up_to of Task_group.t * Task_group.state

let view t i =
  let key = load t i in
  let number = Layouts.number t.shapes key.(0) in
  let exact () =
    let c, outside = Encoding.read t.words key in
    Exact (c, outside)
  in
  if number = 0 then exact ()
  else
    let s = Layouts.shape t.shapes number in
    match s.frame.symmetry with
    | None -> exact ()
    | Some g -> Up_to (g, Quotient.state t.quotient g s key (Layouts.shared t.shapes key.(0)))

let quotient_state t g (c : Configuration.t) outside : Task_group.state option =
  match c.control with
  | Executing (_, r) ->
    let rs = match r with Parallel rs -> rs | r -> [ r ] in
    let shared = Memoised_steps.Shareds.number (Memoised_steps.shareds t.cases) (Surroundings.make c.shared outside) in
    Some (Task_group.state g rs shared)
  | Script _ | Waiting _ | Ended _ -> None

let breaks t i =
  let key = load t i in
  if Layouts.number t.shapes key.(0) > 0 then None else Encoding.broken t.words (Layouts.shared t.shapes key.(0))

(* {1 Findings} *)

let count t = Dolphin_checker.States.count t.states
let transitions t = t.transitions
let parent t i = Dolphin_checker.States.parent t.states i
let used_task_symmetry t = Option.fold ~none:false ~some:Task_groups.is_used t.task_groups
let used_vehicle_symmetry t = Option.fold ~none:false ~some:Canonical_vehicles.is_used t.vehicles

(* If an error handler has run in some task, so have those of its orbit, in other runs. *)
let coverage t =
  let coverage = Components.coverage t.parts in
  let is_run = function Task_isomorphism.Task _ -> false | Code id -> Coverage.is_run coverage id in
  let cover labels = if List.exists is_run labels then List.iter (Quotient.cover coverage) labels in
  Option.iter (fun groups -> Task_groups.equivalent_handlers groups cover) t.task_groups;
  coverage

let bytes t = Dolphin_checker.States.bytes t.states
let bytes_to_grow t ~by = Dolphin_checker.States.bytes_to_grow t.states ~by
let forget_waiting t = Dolphin_checker.States.forget_waiting t.states
let shown t = if t.shown < 0 then None else Some t.shown
let watched t i = Layouts.watched t.shapes (load t i).(0)
let executes t i = Layouts.number t.shapes (load t i).(0) > 0
let words t = Dolphin_checker.States.words t.states
let may_cycle t = Script_graph.may_cycle t.script

let create = Expansion.create
let broken = Expansion.broken
let flush = Expansion.flush

let statistics ppf t =
  let widths = Layouts.widths t.shapes in
  Format.fprintf ppf "%d words; widths: shape %d, shared %d; %d shapes, %d shared, %d configurations" (words t)
    widths.shape widths.shared (Layouts.count t.shapes)
    (Memoised_steps.Shareds.count (Memoised_steps.shareds t.cases))
    (Encoding.count_wholes t.words)
