open Dolphin_semantics
open Core

type component = { steps : int array; beside : Footprint.t; alone : bool array }

type t = {
  footprints : Footprint.t array;
  ends : bool array;
  components : component array;
  branches : Footprint.t array;
  future : Footprint.t;
}

type step = { index : int; source : Residual.step; event : Transition.event option }
type context = { options : Environment.options; code : Footprint.code }

let context options program = { options; code = Footprint.code program }
let union = Footprint.union
let all = List.fold_left union Footprint.empty
let breaking = { Footprint.empty with breaks = true }

(* {1 Futures} *)

let ending c (p : platform_task) v =
  if Environment.may_fail c.options v p.name then breaking else Footprint.empty

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
  | Until (g, r) -> union (Footprint.of_guard c.code g) (future c r)
  | Idle _ -> Footprint.empty
  | During { duration = Seconds _; body; _ } -> future c body
  | During { duration = Given_by d; body; _ } -> all [ breaking; Footprint.of_code c.code d; future c body ]
  | Watch (r, handler) -> handled c (future c r) handler

and of_branch c (b : Residual.branch) = union (Footprint.of_guard c.code b.guard) (future c b.body)

(* {1 Steps} *)

let handlers (source : Residual.step) =
  let error = Fault.make Fault.unknown_site "" in
  let rec of_change (change : Residual.change) =
    match change.outcome with
    | Handling { handler; propagated; _ } -> handler :: of_change (propagated error)
    | Next _ | Finished | Failed _ -> []
  in
  of_change (source.continue (Broke error))

let footprint c step =
  let f =
    match step.source.offer, step.event with
    | End_of (p, v), Some (Vehicle_failed _) -> ending c p v
    | (Start _ | End_of _ | Expiry_of _), _ -> Footprint.empty
    | Perform a, _ -> Footprint.of_code c.code a
    | Check g, _ -> Footprint.of_guard c.code g
    | Measure d, _ -> union breaking (Footprint.of_code c.code d)
  in
  if f.breaks then List.fold_left (handled c) f (handlers step.source) else f

(* {1 Branches that may run first} *)

(* A body whose steps are always possible, touch nothing, and can end it. *)
let rec is_settled c (r : Residual.t) =
  match r with
  | Ready (p, v) | Running (p, v) -> Environment.may_succeed c.options v p.name
  | Action a ->
    let f = Footprint.of_code c.code a in
    Footprint.is_free f && (not f.breaks) && not f.halts
  | Idle _ -> true
  | Sequence (r, rest) -> List.for_all (is_settled c) (r :: rest)
  | Parallel rs -> List.for_all (is_settled c) rs
  | Condition _ | All_of _ | One_of _ | Until _ | During _ | Watch _ -> false

let only_takes (f : Footprint.t) =
  Footprint.(Pairs.is_empty f.posts && Pairs.is_empty f.tests && Globals.is_empty f.writes && not f.anything)

(* By branch: its footprint, if it may run first. [around] is what handlers of its errors touch. *)
let alone c around (bs : Residual.branch list) =
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

(* {1 Components} *)

type part = { count : int; others : Footprint.t; first : Footprint.t option list }

let rec split c around others (r : Residual.t) found =
  match r with
  | Sequence (r, _) | All_of (Some r, _) -> split c around others r found
  | Watch (r, handler) when not ((Footprint.of_code c.code handler).ignores && (future c r).breaks) ->
    split c (union around (Footprint.of_code c.code handler)) others r found
  | Parallel rs ->
    let future r =
      let f = future c r in
      if f.breaks then union f around else f
    in
    let futures = List.map future rs in
    let rec each before futures rs found =
      match futures, rs with
      | f :: futures, r :: rs ->
        let found = split c around (union others (union before (all futures))) r found in
        each (union before f) futures rs found
      | _, _ -> found
    in
    each Footprint.empty futures rs found
  | All_of (None, bs) -> { count = List.length bs; others; first = alone c around bs } :: found
  | Ready _ | Running _ | Action _ | Condition _ | One_of _ | Until _ | Idle _ | During _ | Watch _ ->
    { count = Seq.fold_left (fun n _ -> n + 1) 0 (Residual.steps r); others; first = [] } :: found

let analyse c r steps =
  let parts = List.rev (split c Footprint.empty Footprint.empty r []) in
  let footprints = Array.map (footprint c) steps in
  let branches = Array.make (Array.length steps) Footprint.empty in
  let numbers = List.init (Array.length steps) Fun.id in
  let component (index, components) part =
    let inside k = steps.(k).index >= index && steps.(k).index < index + part.count in
    let own = Array.of_list (List.filter inside numbers) in
    let first = Array.of_list part.first in
    let is_alone k =
      let i = steps.(k).index - index in
      match if i < Array.length first then first.(i) else None with
      | Some f -> branches.(k) <- f; true
      | None -> false
    in
    (index + part.count, { steps = own; beside = part.others; alone = Array.map is_alone own } :: components)
  in
  let _, components = List.fold_left component (0, []) parts in
  let may_end (f : Footprint.t) = f.breaks || f.halts in
  {
    footprints;
    ends = Array.map may_end footprints;
    components = Array.of_list (List.rev components);
    branches;
    future = future c r;
  }
