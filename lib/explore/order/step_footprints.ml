open Dolphin_semantics
open Dolphin_environment
open Core

type t = {
  footprints : Footprint.t array;
  ends : bool array;
  put_off : bool array;
  futures : Footprint.t array;
  cut_by_error : bool array;
  runs_first : Footprint.t option array;
}

(* Of task terms, by identity: a handler that may give back the watched task holds it once more. *)
module Terms = Hashtbl.Make (struct
    type t = task

    let equal = ( == )
    let hash t = Value.hash (Task t)
  end)

type step = { index : int; source : Task_rules.step; event : Transition.event option }
type context = {
  options : Environment.options;
  code : Footprint.code;
  makes : bool;
  asks_held : bool;
  asks_running : bool;
  leaks : bool;  (* a key of some [fresh] may be known outside of its task *)
  terms : Footprint.t Terms.t;  (* those known so far of one component *)
  ensured : Footprint.t option;  (* of all that tasks ensure *)
}

(* {1 Tasks made at their turn} *)

let context options program =
  { options; code = Footprint.code program; makes = false; asks_held = Footprint.asks_held program;
    asks_running = program.Core.asks_running; leaks = (Name_flow.of_program program ~asked:[]).leaks;
    terms = Terms.create 1; ensured = Footprint.all_ensured program }
let with_holding c = { c with makes = true }
let for_one_component c = { c with terms = Terms.create 16 }
let union = Footprint.union
let all = List.fold_left union Footprint.empty
let breaking = { Footprint.empty with breaks = true }

(* {1 Futures} *)

(* Of a guard that is evaluated and fails where it is not true: the effects of its code are undone. *)
let of_refuted c g =
  let f = Footprint.of_code c.code g in
  let none = Footprint.empty in
  union { f with posts = none.posts; queues = none.queues; takes = none.takes; writes = none.writes } breaking

(* Free vehicles matter only where tasks are made, or asked for idle vehicles. *)
let freed c vs = if c.makes || c.asks_held then Footprint.these vs else Footprint.these []

(* Of the start or the end of a task of [v]: code that asks [running(v)] depends on it. *)
let turning c v = if c.asks_running then { Footprint.empty with frees = Footprint.these [ v ] } else Footprint.empty

let ending c (p : platform_task) v =
  let remembered = Environment.endings_remember c.options in
  { (turning c v) with remembered; breaks = Environment.may_fail c.options v p.name }

(* Of a question: it fails if it is not answered by yes. *)
let answering c prompt =
  if List.for_all (( = ) (Ok true)) (Environment.confirmations c.options prompt) then Footprint.empty else breaking

(* Of this handler, in the step that fails. *)
let handling c (handler : Residual.handler) =
  let f = Footprint.of_code c.code handler.code in
  if handler.anew = None then f else { f with ignores = true }

(* Vehicles that a task made here may claim are free after it. *)
let claiming (request : Residual.request) =
  let vehicles = Option.fold ~none:Footprint.all_vehicles ~some:Footprint.these request.allowed in
  { breaking with claims = vehicles; frees = vehicles }

(* The plans and code run by a handler that may recover, except for the watched task itself. *)
let recovering c (code : closure) request =
  let given = if Recovery.may_give code.lambda then Footprint.of_maker c.code code else Footprint.empty in
  all [ claiming request; given; { Footprint.empty with ignores = true } ]

(* Of a wait for a vehicle: a recruited vehicle cannot be recruited elsewhere, and is free afterwards. *)
let recruiting c code =
  let any = { breaking with claims = Footprint.all_vehicles; frees = Footprint.all_vehicles } in
  union any (Footprint.of_maker c.code code)

let ensured c = Option.value c.ensured ~default:Footprint.empty

(* An error may cut tasks off, which does their ensured deeds. *)
let with_ensured c (f : Footprint.t) = if f.breaks then union f (ensured c) else f

let rec future c (r : Residual.t) =
  match r with
  | Ready (p, v) | Running (p, v) -> { (ending c p v) with frees = freed c [ v ] }
  | Action a -> Footprint.of_code c.code a
  | Condition g -> Footprint.of_guard c.code g
  | Sequence (r, rest) -> all (List.map (future c) (r :: rest))
  | Parallel bs -> all (List.map (future c) (Branches.to_list bs))
  | All_of (running, bs) -> all (Option.to_list (Option.map (future c) running) @ List.map (of_branch c) bs)
  | One_of bs -> all (List.map (of_branch c) bs)
  | Until (Completes _, g, r) -> union (Footprint.of_guard c.code g) (future c r)
  | Until (Fails _, g, r) -> union (of_refuted c g) (future c r)
  | Idle _ -> Footprint.empty
  | Confirm { prompt; _ } -> answering c prompt
  | During { on_cut = Completes _; duration = Seconds _; body; _ } -> future c body
  | During { on_cut = Fails _; duration = Seconds _; body; _ } -> union breaking (future c body)
  | During { duration = Given_by d; body; _ } -> all [ breaking; Footprint.of_code c.code d; future c body ]
  | Watch (r, handler) -> handled c (future c r) handler
  | Repeat { again; _ } -> rounds c again (* the rest of the current round of each *)
  | Made { code; request; _ } -> union (Footprint.of_maker c.code code) (claiming request)
  | Unallocated { task; request } -> union (claiming request) (of_term c task)
  | Hold (vs, r) -> union { Footprint.empty with frees = freed c vs } (future c r)
  | Recruit { code; _ } -> recruiting c code
  | Recruited (v, r) -> union { Footprint.empty with frees = freed c [ v ] } (future c r)
  | Fresh (_, r) -> future c r
  | Ensure (_, r) -> union (ensured c) (future c r)

and rounds c (again : Residual.again) =
  let asked = Option.fold again.until ~none:Footprint.empty ~some:(Footprint.of_code c.code) in
  union asked (future c again.each)

(* Of a task whose errors this handler gets. *)
and handled c (f : Footprint.t) handler = if f.breaks then union f (of_handler c handler) else f

and of_handler c (handler : Residual.handler) =
  match handler.anew with
  | None -> handling c handler
  | Some (task, request) -> all [ handling c handler; recovering c handler.code request; of_shared c task ]

and of_shared c t =
  match Terms.find_opt c.terms t with
  | Some f -> f
  | None ->
    let f = of_term c t in
    Terms.add c.terms t f;
    f

and of_term c (t : task) =
  match t with
  | Platform _ -> { breaking with remembered = true }
  | Action a -> Footprint.of_code c.code a
  | Condition g -> Footprint.of_guard c.code g
  | Sequence (a, b) | Parallel (a, b) -> union (of_term c a) (of_term c b)
  | Allocated (a, _) -> of_term c a
  | All_of bs | One_of bs ->
    all (List.map (fun (b : Core.branch) -> union (Footprint.of_guard c.code b.guard) (of_term c b.body)) bs)
  | Until (Completes _, g, a) -> union (Footprint.of_guard c.code g) (of_term c a)
  | Until (Fails _, g, a) -> union (of_refuted c g) (of_term c a)
  | Idle _ -> Footprint.empty
  | Confirm { prompt; _ } -> answering c prompt
  | During (_, Seconds _, a) -> union breaking (of_term c a)
  | During (_, Given_by d, a) -> all [ breaking; Footprint.of_code c.code d; of_term c a ]
  | Watch (a, code) ->
    let f = of_shared c a in
    if not f.breaks then f
    else if not (Recovery.possible code.lambda) then union f (Footprint.of_code c.code code)
    else all [ f; Footprint.of_code c.code code; recovering c code { allowed = None; place = 0; depth = 0 } ]
  | Made code | Fresh code -> Footprint.of_maker c.code code
  | Ensure (_, a) -> union (ensured c) (of_term c a)
  | Recruit { code; _ } -> recruiting c code
  | Repeat { until; body; _ } ->
    union (Option.fold until ~none:Footprint.empty ~some:(Footprint.of_code c.code)) (of_term c body)

and of_branch c (b : Residual.branch) = union (Footprint.of_guard c.code b.guard) (future c b.body)

(* Whose keys others may know, it may touch what they do at any step. *)
let widened c f = with_ensured c (if c.leaks then union f Footprint.anything else f)

let of_residual c r =
  let c = for_one_component c in
  widened c (future c r)

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

(* [own] is the vehicles recruited by the component: no other component may have, or look for, one of them. *)
let footprint ?(own = []) c { source = Step { offer; continue; _ } as source; event; _ } =
  let is_own (request : Residual.request) =
    match request.allowed with Some vs -> List.for_all (fun v -> List.mem v own) vs | None -> false
  in
  let f =
    match offer, event with
    | End_of (p, v), Some (Vehicle_failed _) -> ending c p v
    | End_of (p, v), _ -> { (ending c p v) with breaks = false }
    | Start (_, v), _ -> turning c v
    | Expiry_of _, _ -> if is_error (continue ()) then breaking else Footprint.empty
    | Answer_to _, Some (Confirmed (_, Ok true)) -> Footprint.empty
    | Answer_to _, _ -> breaking
    | Recruit_for _, Some (Recruited (_, v)) -> { Footprint.empty with claims = Footprint.these [ v ] }
    | Recruit_for _, _ -> { Footprint.empty with claims = Footprint.all_vehicles }
    | Perform a, _ -> Footprint.of_code c.code a
    | Check g, _ -> Footprint.of_guard c.code g
    | Guard_false g, _ -> of_refuted c g
    | Guard_either g, _ -> Footprint.of_code c.code g
    | Guard_values g, _ -> Footprint.of_guard c.code g
    | Measure d, _ -> union breaking (Footprint.of_code c.code d)
    | Make (code, _, _), _ -> union breaking (Footprint.of_code c.code code)
    | Allocate (task, request), _ ->
      let code = all (List.map (Footprint.of_code c.code) (Allocation.fresh task)) in
      union code (if is_own request then breaking else claiming request)
  in
  if f.breaks then all (f :: List.map (handling c) (handlers source)) else f

(* {2 What is held no longer after a step} *)

let concerns_holding c = c.makes || c.asks_held

(* The outcome of a step if all goes well. [Errs]: it is sure to fail. *)
type success = Changes of Task_rules.change | Goes_on | Is_over | Errs

let success (Task_rules.Step { offer; continue; _ }) =
  match offer with
  | Start _ -> Changes (continue ())
  | Perform _ -> Changes (continue (Ok []))
  | Check _ -> Changes (continue (Ok []))
  | Guard_values _ -> Changes (continue (Ok []))
  | End_of _ -> Changes (continue (Ok ()))
  | Measure _ -> Changes (continue (Ok 0.))
  | Expiry_of _ -> Changes (continue ())
  | Answer_to _ -> Changes (continue (Ok true))
  | Make _ | Allocate _ | Recruit_for _ -> Goes_on
  | Guard_either _ -> Is_over
  | Guard_false _ -> Errs

(* The vehicles that the residual [r], in contexts that hold [outer], names no longer if all goes well; [failed] if an
   error is handled. *)
let lost r outer ~failed { source; _ } =
  match success source with
  | Changes { outcome = Next r'; _ } ->
    let after = Residual.named r' in
    Footprint.these (List.filter (fun v -> not (List.mem v after)) (Residual.named r))
  | Changes { outcome = Finished; _ } | Is_over -> Footprint.these (Residual.named r @ outer)
  | Changes { outcome = Failed _ | Handling _; _ } | Errs -> failed
  | Goes_on -> Footprint.these []

(* Whether a step may be the last of its component: the parts around it are over if nothing else is left in them. *)
let may_finish { source; _ } =
  match success source with
  | Changes { outcome = Finished; _ } | Is_over -> true
  | Changes { outcome = Next _ | Failed _ | Handling _; _ } | Goes_on | Errs -> false

(* [f], the footprint of [step], with the vehicles that it frees. An ignored error also frees those that it cuts off. *)
let with_lost c ~ignoring ~failed lost step (f : Footprint.t) =
  if not (concerns_holding c) then f
  else
    let lost = union f { Footprint.empty with frees = lost step } in
    if f.breaks && ignoring then union lost { Footprint.empty with frees = failed } else lost

(* {1 Branches that may run first} *)

(* A body whose steps are always possible, touch nothing, and can end it. *)
let rec is_settled c (r : Residual.t) =
  match r with
  | Ready (p, v) | Running (p, v) -> Environment.may_succeed c.options v p.name
  | Action a ->
    let f = Footprint.of_code c.code a in
    Footprint.touches_nothing f && (not f.breaks) && not f.halts
  | Idle _ -> true
  | Confirm { prompt; _ } -> List.mem (Ok true) (Environment.confirmations c.options prompt)
  | Sequence (r, rest) -> List.for_all (is_settled c) (r :: rest)
  | Parallel bs -> List.for_all (is_settled c) (Branches.to_list bs)
  | _ -> false

let only_takes (f : Footprint.t) =
  Footprint.(Pairs.is_empty f.posts && Pairs.is_empty f.tests && Globals.is_empty f.writes && not f.anything)

(* By branch: its footprint, if it may run first. [around] is the footprint of the handlers of its errors. *)
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

(* The footprints of an [allOf] that waits, where errors cannot be ignored; [around] as above. Tasks that hold
   vehicles until the [allOf] is over would release them if another branch came last. *)
let rec first_branches c around (r : Residual.t) =
  match r with
  | Sequence (r, _) | All_of (Some r, _) -> first_branches c around r
  | Watch (r, handler) when not ((of_handler c handler).ignores && (future c r).breaks) ->
    first_branches c (union around (of_handler c handler)) r
  | All_of (None, bs) -> branches_first c around bs
  | _ -> []

(* {1 Components} *)

(* The footprint of handlers among the contexts, and of the tasks that start when everything in them is over. *)
let handlers_of c contexts =
  let handler = function
    | Residual.In_watch handler -> Some (of_handler c handler)
    | In_sequence _ | Branch_of _ | Body_until _ | Body_during _ | Round_of _ | Holding _ | In_recruited _
    | With_keys _ | Ensuring _ -> None
  in
  List.filter_map handler contexts

let following c contexts =
  let following = function
    | Residual.In_sequence rest -> all (List.map (future c) rest)
    | Branch_of bs -> all (List.map (of_branch c) bs)
    | Round_of again -> rounds c again
    | Holding vs -> { Footprint.empty with frees = freed c vs }
    | In_recruited v -> { Footprint.empty with frees = freed c [ v ] }
    | Ensuring _ -> ensured c
    | Body_until _ | Body_during _ | In_watch _ | With_keys _ -> Footprint.empty
  in
  all (List.map following contexts)

(* The requested vehicles may never come. *)
let may_be_put_off c { source = Step { offer; _ }; _ } =
  let { Environment.faults; _ } = c.options in
  match offer with
  | Recruit_for _ -> Faults.is_possible faults.join || Faults.is_possible faults.loss
  | Start _ | Perform _ | Check _ | Guard_false _ | Guard_either _ | Guard_values _ | Measure _ | Make _ | Allocate _
  | End_of _ | Expiry_of _ | Answer_to _ -> false

(* [first] is the future of the component itself; each of its steps may touch what [always] does, and one that may be
   its last what [last] does. An error may reach any handler around. If none of these ignores it, the error cuts off
   the component alone, whose vehicles are [failed]. *)
let analyse ?own ?(last = Footprint.empty) ~always c nests (first : Footprint.t) branches ~failed ~lost steps =
  let around = all (List.concat_map (handlers_of c) nests) in
  let ignoring = around.ignores || first.ignores in
  let failed = if around.ignores then Footprint.all_vehicles else failed in
  let with_lost lost = with_lost c ~ignoring ~failed lost in
  let first = with_lost (fun () -> Footprint.these []) () first in
  let with_handlers (f : Footprint.t) = if f.breaks then union (with_ensured c f) around else f in
  let further futures contexts =
    match futures with
    | f :: _ -> with_handlers (union f (following c contexts)) :: futures
    | [] -> [ with_handlers (widened c first) ]
  in
  let futures = Array.of_list (List.rev (List.fold_left further (further [] []) nests)) in
  let ignores (f : Footprint.t) = f.ignores in
  let cut_by_error level contexts = futures.(level).breaks && List.exists ignores (handlers_of c contexts) in
  let of_step step =
    let f = union always (footprint ?own c step) in
    widened c (with_lost (lost ~failed) step (if may_finish step then union last f else f))
  in
  let footprints = Array.map of_step steps in
  let may_end (f : Footprint.t) = f.breaks || f.halts in
  {
    footprints;
    ends = Array.map may_end footprints;
    put_off = Array.map (may_be_put_off c) steps;
    futures;
    cut_by_error = Array.of_list (false :: List.mapi cut_by_error nests);
    runs_first = Array.map (fun step -> Option.join (List.nth_opt branches step.index)) steps;
  }

let of_component c nests r steps =
  let c = for_one_component c in
  let own_ensured = if Residual.ensures r then ensured c else Footprint.empty in
  let is_end = function
    | Residual.Ensuring _ -> true
    | In_sequence _ | Branch_of _ | Body_until _ | Body_during _ | In_watch _ | Round_of _ | Holding _ | In_recruited _
    | With_keys _ -> false
  in
  (* The last step in a part does, by itself, what the part ensures. *)
  let last = if List.exists (List.exists is_end) nests then ensured c else Footprint.empty in
  let around = all (List.concat_map (handlers_of c) nests) in
  let named = function
    | Residual.In_sequence rest -> List.concat_map Residual.named rest
    | Branch_of bs -> List.concat_map (fun (b : Residual.branch) -> Residual.named b.body) bs
    | Holding vs -> vs
    | In_recruited v -> [ v ]
    | Round_of again -> Residual.named again.each
    | Body_until _ | Body_during _ | In_watch _ | With_keys _ | Ensuring _ -> []
  in
  let outer = if concerns_holding c then List.concat_map (List.concat_map named) nests else [] in
  let own = Residual.recruits (Residual.plug (fst (Residual.decompose r)) Residual.hole) in
  let holds = function
    | Residual.Holding _ | In_recruited _ -> true
    | In_sequence _ | Branch_of _ | Body_until _ | Body_during _ | In_watch _ | Round_of _ | With_keys _ | Ensuring _ ->
      false
  in
  let branches = if c.leaks || List.exists (List.exists holds) nests then [] else first_branches c around r in
  let failed = Footprint.these (Residual.named r @ outer) in
  analyse ~own ~always:own_ensured ~last c nests (future c r) branches ~failed ~lost:(lost r outer) steps

let of_cuts c nests steps =
  let c = for_one_component c in
  match nests with
  | [] -> invalid_arg "Step_footprints.of_cuts: no nest"
  | contexts :: nests ->
    let f = all (ensured c :: following c contexts :: Array.to_list (Array.map (footprint c) steps)) in
    let first = if f.breaks then all (f :: handlers_of c contexts) else f in
    let lost = Footprint.all_vehicles in
    let first = if concerns_holding c then union first { Footprint.empty with frees = lost } else first in
    analyse ~always:(ensured c) c nests first [] ~failed:lost ~lost:(fun ~failed:_ _ -> lost) steps

(* {1 Steps that look at what is held} *)

let looks c (Task_rules.Step { offer; _ } as source) =
  let claims code = Footprint.claims (Footprint.of_code c.code code) in
  let code_claims =
    match offer with
    | Allocate _ | Recruit_for _ -> true
    | _ when not c.asks_held -> false
    | Perform a -> claims a
    | Check g -> claims g
    | Guard_values g -> claims g
    | Guard_false g -> claims g
    | Guard_either g -> claims g
    | Measure d -> claims d
    | Make (code, _, _) -> claims code
    | Start _ | End_of _ | Expiry_of _ | Answer_to _ -> false
  in
  code_claims || (c.asks_held && List.exists (fun (h : Residual.handler) -> claims h.code) (handlers source))
