open Dolphin_semantics
module Shareds = Interner.Make (Shared)

type target =
  | Stays of int
  | Gone
  | Becomes of { serial : int; parts : part array }
  | Ends of Configuration.ending

and part = {
  residual : Residual.t;
  family : family;
  local : int;
  mutable steps : step array;
  mutable worked_out : step array option;
  mutable components : Components.t option;
}

and family = { number : int; mutable members : part array; mutable size : int; mutable width : int }
and dependence = Free | Guarded of guard | By_case
and guard = { mutable results : int array }
and case = {
  possible : bool;
  certain : bool;
  shared : int;
  result : target;
  mutable whole : int;
  others : case list;
}

and step = {
  index : int;
  source : Residual.step;
  event : Transition.event option;
  dependence : dependence;
  target : target;
  stays : int;
  mutable cases : case array;
}

let unknown = -1
let impossible = -2
let special = -3

module Residuals = Hashtbl.Make (Residual)

(* A guard is known by its code, and by whether the code's value matters. *)
module Guards = Hashtbl.Make (struct
    type t = bool * Core.closure

    let equal (check, c) (check', c') = check = check' && Value.compare_closure c c' = 0
    let hash (check, c) = (2 * Value.hash_closure c) + Bool.to_int check
  end)

type t = {
  options : Environment.options;
  program : Core.program;
  world : World.t;
  shareds : Shareds.t;
  parts : part Residuals.t;
  guards : guard Guards.t;
  coverage : Coverage.t;
  context : Components.context;
  foreseen : int;
  mutable families : int;
  mutable serial : int;
  mutable outgrown : bool;
}

let create ?(foreseen = 2_048) options program world =
  {
    options;
    program;
    world;
    shareds = Shareds.create ();
    parts = Residuals.create 1_000;
    guards = Guards.create 64;
    coverage = Coverage.create ();
    context = Components.context options program;
    foreseen;
    families = 0;
    serial = 0;
    outgrown = false;
  }

let shareds t = t.shareds
let coverage t = t.coverage

(* {1 Parts and families} *)

let bits_for size =
  let rec from bits = if 1 lsl bits >= size then bits else from (bits + 1) in
  from 1

let lay_out family = family.width <- bits_for family.size
let outgrown t = t.outgrown
let none_outgrown t = t.outgrown <- false

let grown xs length x =
  let longer = Array.make (max length (2 * Array.length xs)) x in
  Array.blit xs 0 longer 0 (Array.length xs);
  longer

let member t family residual =
  let p = { residual; family; local = family.size; steps = [||]; worked_out = None; components = None } in
  if family.size = Array.length family.members then family.members <- grown family.members 8 p;
  family.members.(family.size) <- p;
  family.size <- family.size + 1;
  if family.width > 0 && family.size > 1 lsl family.width then t.outgrown <- true;
  Residuals.add t.parts residual p;
  p

let new_family t =
  t.families <- t.families + 1;
  { number = t.families - 1; members = [||]; size = 0; width = 0 }

let guard t check closure =
  match Guards.find_opt t.guards (check, closure) with
  | Some guard -> guard
  | None ->
    let guard = { results = [||] } in
    Guards.add t.guards (check, closure) guard;
    guard

(* {1 Steps} *)

let rec part t residual =
  match Residuals.find_opt t.parts residual with
  | Some p -> p
  | None ->
    let family = new_family t in
    let p = member t family residual in
    let rec foresee i =
      if i < family.size && i < t.foreseen then begin
        ignore (work_out t family.members.(i));
        foresee (i + 1)
      end
    in
    foresee 0;
    p

and target_of t family residual =
  let becomes parts =
    t.serial <- t.serial + 1;
    Becomes { serial = t.serial; parts }
  in
  match (residual : Residual.t) with
  | Parallel rs -> becomes (Array.of_list (List.map (part t) rs))
  | residual -> (
      match Residuals.find_opt t.parts residual with
      | Some p when p.family == family -> Stays p.local
      | Some p -> becomes [| p |]
      | None -> Stays (member t family residual).local)

and target_of_outcome t family : Transition.outcome -> target = function
  | Goes_on r -> target_of t family r
  | Over -> Gone
  | Ends ending -> Ends ending

(* Steps that go on in one way, whatever is shared, are settled here; the others case by case. *)
and work_out t p =
  match p.worked_out with
  | Some steps -> steps
  | None ->
    let by_case index source event =
      { index; source; event; dependence = By_case; target = Gone; stays = -1; cases = [||] }
    in
    let certain index source event dependence =
      let settled target =
        let stays = match target with Stays n -> n | Gone | Becomes _ | Ends _ -> -1 in
        { index; source; event; dependence; target; stays; cases = [||] }
      in
      match (source.Residual.continue Went).outcome with
      | Next r -> settled (target_of t p.family r)
      | Finished -> settled Gone
      | Failed _ | Handling _ -> by_case index source event
    in
    let compile index (source : Residual.step) =
      match source.offer with
      | Start _ -> [ certain index source None Free ]
      | Perform closure -> [ certain index source None (Guarded (guard t false closure)) ]
      | Check closure -> [ certain index source None (Guarded (guard t true closure)) ]
      | Measure _ -> [ by_case index source None ]
      | Expiry_of timer -> [ certain index source (Some (Timer_expired timer)) Free ]
      | End_of (task, v) ->
        let on_event (event, _) =
          match event with
          | Transition.Vehicle_done _ when not (Environment.endings_remember t.options) ->
            certain index source (Some event) Free
          | event -> by_case index source (Some event)
        in
        List.map on_event (Environment.task_ends t.options Environment.initial v task)
    in
    let steps = Array.of_list (List.concat (List.mapi compile (List.of_seq (Residual.steps p.residual)))) in
    p.worked_out <- Some steps;
    steps

(* Code of a part that is reached is run, whatever comes of it. *)
let reach t p =
  let steps = work_out t p in
  let cover step =
    match step.source.Residual.offer with
    | Start (task, _) -> Coverage.start t.coverage task
    | Perform c | Check c | Measure c -> Coverage.run t.coverage c
    | End_of _ | Expiry_of _ -> ()
  in
  Array.iter cover steps;
  p.steps <- steps

let components t p =
  match p.components with
  | Some components -> components
  | None ->
    let step { index; source; event; _ } : Components.step = { index; source; event } in
    let components = Components.analyse t.context p.residual (Array.map step (work_out t p)) in
    p.components <- Some components;
    components

(* {1 What depends on what is shared} *)

let configuration shared = Shared.under (Ended Interrupted) shared

(* The handlers that ran: one for each rule of a handler in the derivation, the innermost first. *)
let note_handlers t (change : Residual.change) (local : Transition.local) =
  let of_handler = function Rule.Watch_ignore | Watch_propagate | Watch_halt | Assert_err -> true | _ -> false in
  let settled = match local.derivation with Rule.Assert_err :: _ -> [] | rules -> List.filter of_handler rules in
  let rec note n (change : Residual.change) =
    match change.outcome with
    | Handling { handler; fault; propagated; _ } when n > 0 ->
      Coverage.run t.coverage handler;
      note (n - 1) (propagated fault)
    | Handling _ | Next _ | Finished | Failed _ -> ()
  in
  note (List.length settled) change

let internal t step s =
  let shared = Shareds.value t.shareds s in
  let locals = Transition.local_internal t.program t.world (configuration shared) step.source in
  (match step.source.offer with
   | Perform _ | Check _ | Measure _ ->
     let broken = Residual.Broke (Fault.make Fault.unknown_site "") in
     List.iter (note_handlers t (step.source.continue broken)) locals
   | Start _ | End_of _ | Expiry_of _ -> ());
  (locals, shared.outside)

let on_event t step event s =
  let shared = Shareds.value t.shareds s in
  let take outside =
    let locals = Transition.local_event t.program t.world (configuration shared) step.source event in
    let broken = Residual.Broke (Fault.make Fault.unknown_site "") in
    List.iter (note_handlers t (step.source.continue broken)) locals;
    (locals, outside)
  in
  match step.source.offer with
  | End_of (task, v) -> (
      match List.assoc_opt event (Environment.task_ends t.options shared.outside v task) with
      | Some outside -> take outside
      | None -> ([], shared.outside))
  | Start _ | Perform _ | Check _ | Measure _ | Expiry_of _ -> take shared.outside

let shared_after t (local : Transition.local) outside =
  Shareds.number t.shareds (Shared.of_configuration local.after outside)

let guarded t step guard s =
  if s >= Array.length guard.results then guard.results <- grown guard.results (s + 1) unknown;
  if guard.results.(s) = unknown then
    guard.results.(s) <-
      (match internal t step s with
       | [], _ -> impossible
       | [ ({ named = Check _ | Act _ | Cut _; assumed = []; _ } as local) ], outside -> shared_after t local outside
       | _ :: _, _ -> special);
  guard.results.(s)

let no_case = { possible = false; certain = true; shared = -1; result = Gone; whole = -1; others = [] }

(* What sensors show that may show anything makes several of one step. *)
let case_of t family outside locals =
  let one others (local : Transition.local) =
    let result = target_of_outcome t family local.outcome in
    let certain = local.assumed = [] in
    { possible = true; certain; shared = shared_after t local outside; result; whole = -1; others }
  in
  match locals with
  | [] -> { no_case with possible = false }
  | first :: rest -> one (List.map (one []) rest) first

let case t family step s =
  if s >= Array.length step.cases then step.cases <- grown step.cases (s + 1) no_case;
  if step.cases.(s) == no_case then
    step.cases.(s) <-
      (let locals, outside =
         match step.event with None -> internal t step s | Some event -> on_event t step event s
       in
       case_of t family outside locals);
  step.cases.(s)
