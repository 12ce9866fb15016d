open Dolphin_semantics
open Dolphin_environment
open Core

type t = {
  footprints : Footprint.t array;
  ends : bool array;
  futures : Footprint.t array;
  cut_by_error : bool array;
  runs_first : Footprint.t option array;
}

type step = { index : int; source : Task_rules.step; event : Transition.event option }
type context = { options : Environment.options; code : Footprint.code }

let context options program = { options; code = Footprint.code program }
let union = Footprint.union
let all = List.fold_left union Footprint.empty
let breaking = { Footprint.empty with breaks = true }

(* {1 Futures} *)

(* Of a guard that is looked at, and fails where it is not true: what its code does is undone. *)
let of_refuted c g =
  let f = Footprint.of_code c.code g in
  let none = Footprint.empty in
  union { f with posts = none.posts; queues = none.queues; takes = none.takes; writes = none.writes } breaking

let ending c (p : platform_task) v =
  let remembered = Environment.endings_remember c.options in
  { Footprint.empty with remembered; breaks = Environment.may_fail c.options v p.name }

(* Of a task whose errors this handler gets. *)
let handled c (f : Footprint.t) handler = if f.breaks then union f (Footprint.of_code c.code handler) else f

let rec future c (r : Residual.t) =
  match r with
  | Ready (p, v) | Running (p, v) -> ending c p v
  | Action a -> Footprint.of_code c.code a
  | Condition g -> Footprint.of_guard c.code g
  | Sequence (r, rest) -> all (List.map (future c) (r :: rest))
  | Parallel rs -> all (List.map (future c) rs)
  | All_of (running, bs) -> all (Option.to_list (Option.map (future c) running) @ List.map (of_branch c) bs)
  | One_of bs -> all (List.map (of_branch c) bs)
  | Until (Completes, g, r) -> union (Footprint.of_guard c.code g) (future c r)
  | Until (Fails _, g, r) -> union (of_refuted c g) (future c r)
  | Idle _ -> Footprint.empty
  | During { on_cut = Completes; duration = Seconds _; body; _ } -> future c body
  | During { on_cut = Fails _; duration = Seconds _; body; _ } -> union breaking (future c body)
  | During { duration = Given_by d; body; _ } -> all [ breaking; Footprint.of_code c.code d; future c body ]
  | Watch (r, handler) -> handled c (future c r) handler
  | Repeat { again; _ } -> rounds c again (* what is left of the round that runs is in each round *)

and rounds c (again : Residual.again) =
  let asked = Option.fold again.until ~none:Footprint.empty ~some:(Footprint.of_code c.code) in
  union asked (future c again.each)

and of_branch c (b : Residual.branch) = union (Footprint.of_guard c.code b.guard) (future c b.body)

let of_residual = future

(* {1 Steps} *)

let is_error (change : Task_rules.change) =
  match change.outcome with Failed _ | Handling _ -> true | Next _ | Finished -> false

let handlers source =
  let error = Fault.make Fault.unknown_site "" in
  let rec of_change (change : Task_rules.change) =
    match change.outcome with
    | Handling { handler; propagated; _ } -> handler :: of_change (propagated error)
    | Next _ | Finished | Failed _ -> []
  in
  Option.fold ~none:[] ~some:of_change (Task_rules.broken source error)

let footprint c { source = Step { offer; continue } as source; event; _ } =
  let f =
    match offer, event with
    | End_of (p, v), Some (Vehicle_failed _) -> ending c p v
    | End_of (p, v), _ -> { (ending c p v) with breaks = false }
    | Start _, _ -> Footprint.empty
    | Expiry_of _, _ -> if is_error (continue ()) then breaking else Footprint.empty
    | Perform a, _ -> Footprint.of_code c.code a
    | Check g, _ -> Footprint.of_guard c.code g
    | Refute g, _ -> of_refuted c g
    | Decide g, _ -> Footprint.of_code c.code g
    | Measure d, _ -> union breaking (Footprint.of_code c.code d)
  in
  if f.breaks then List.fold_left (handled c) f (handlers source) else f

(* {1 Branches that may run first} *)

(* A body whose steps are always possible, touch nothing, and can end it. *)
let rec is_settled c (r : Residual.t) =
  match r with
  | Ready (p, v) | Running (p, v) -> Environment.may_succeed c.options v p.name
  | Action a ->
    let f = Footprint.of_code c.code a in
    Footprint.touches_nothing f && (not f.breaks) && not f.halts
  | Idle _ -> true
  | Sequence (r, rest) -> List.for_all (is_settled c) (r :: rest)
  | Parallel rs -> List.for_all (is_settled c) rs
  | Condition _ | All_of _ | One_of _ | Until _ | During _ | Watch _ | Repeat _ -> false

let only_takes (f : Footprint.t) =
  Footprint.(Pairs.is_empty f.posts && Pairs.is_empty f.tests && Globals.is_empty f.writes && not f.anything)

(* By branch: its footprint, if it may run first. [around] is what handlers of its errors touch. *)
let branches_first c around (bs : Residual.branch list) =
  let whole = List.map (of_branch c) bs in
  let rec each before (whole : Footprint.t list) (bs : Residual.branch list) =
    match whole, bs with
    | f :: after, b :: bs ->
      let g = Footprint.of_guard c.code b.guard in
      let f' = if f.breaks then union f around else f in
      let clash = List.exists (Footprint.conflict ~possible:true f') in
      let may =
        is_settled c b.body && only_takes f' && (not g.breaks) && (not g.halts) && not (clash before || clash after)
      in
      (if may then Some f' else None) :: each (f :: before) after bs
    | _, _ -> []
  in
  each [] whole bs

(* Those of an [allOf] that waits, where errors cannot be ignored; [around] as above. *)
let rec first_branches c around (r : Residual.t) =
  match r with
  | Sequence (r, _) | All_of (Some r, _) -> first_branches c around r
  | Watch (r, handler) when not ((Footprint.of_code c.code handler).ignores && (future c r).breaks) ->
    first_branches c (union around (Footprint.of_code c.code handler)) r
  | All_of (None, bs) -> branches_first c around bs
  | Parallel _ | Ready _ | Running _ | Action _ | Condition _ | One_of _ | Until _ | Idle _ | During _ | Watch _
  | Repeat _ -> []

(* {1 Components} *)

(* What handlers among the contexts touch, and what starts when all in them is over. *)
let handlers_of c contexts =
  let handler = function
    | Residual.Watched_by handler -> Some (Footprint.of_code c.code handler)
    | Before _ | Branch_of _ | Body_until _ | Body_during _ | Round_of _ -> None
  in
  List.filter_map handler contexts

let following c contexts =
  let following = function
    | Residual.Before rest -> all (List.map (future c) rest)
    | Branch_of bs -> all (List.map (of_branch c) bs)
    | Round_of again -> rounds c again
    | Body_until _ | Body_during _ | Watched_by _ -> Footprint.empty
  in
  all (List.map following contexts)

(* [first] is what the component itself may do. An error may reach any handler around. *)
let analyse c nests first branches steps =
  let around = all (List.concat_map (handlers_of c) nests) in
  let with_handlers (f : Footprint.t) = if f.breaks then union f around else f in
  let further futures contexts =
    match futures with
    | f :: _ -> with_handlers (union f (following c contexts)) :: futures
    | [] -> [ with_handlers first ]
  in
  let futures = Array.of_list (List.rev (List.fold_left further (further [] []) nests)) in
  let ignores (f : Footprint.t) = f.ignores in
  let cut_by_error level contexts = futures.(level).breaks && List.exists ignores (handlers_of c contexts) in
  let footprints = Array.map (footprint c) steps in
  let may_end (f : Footprint.t) = f.breaks || f.halts in
  {
    footprints;
    ends = Array.map may_end footprints;
    futures;
    cut_by_error = Array.of_list (false :: List.mapi cut_by_error nests);
    runs_first = Array.map (fun step -> Option.join (List.nth_opt branches step.index)) steps;
  }

let of_component c nests r steps =
  let around = all (List.concat_map (handlers_of c) nests) in
  analyse c nests (future c r) (first_branches c around r) steps

let of_cuts c nests steps =
  match nests with
  | [] -> invalid_arg "Step_footprints.of_cuts: no nest"
  | contexts :: nests ->
    let f = all (following c contexts :: Array.to_list (Array.map (footprint c) steps)) in
    let first = if f.breaks then all (f :: handlers_of c contexts) else f in
    analyse c nests first [] steps
