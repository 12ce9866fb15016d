open Dolphin_semantics
open Dolphin_environment
open Component

(* The ensured deeds around a step, by its parts. *)
module Owed = Hashtbl.Make (struct
    type t = Core.ensured list list

    let equal = List.equal (List.equal (fun d d' -> Value.compare_ensured d d' = 0))

    let hash dss =
      List.fold_left (List.fold_left (fun h d -> Order.mix h (Value.hash_ensured d))) (List.length dss) dss land max_int
  end)

(* The parts around a step, as far as its effect depends on them: the number of the ensured deeds, vehicles that are
   held, timers, and the vehicles and running tasks that some programs ask for. *)
type seen = int * Core.vehicle list * Residual.timer list * Core.vehicle list list

type surroundings = { around : Residual.surrounding list; owed : owed option; number : int }

type t = {
  components : Components.t;
  encoding : Encoding.t;
  observe : (Local_step.t -> int) option;
  owed : int Owed.t;  (* numbered *)
  seen : (seen, int) Hashtbl.t;  (* numbered *)
}

let create ?observe components encoding =
  { components; encoding; observe; owed = Owed.create 16; seen = Hashtbl.create 64 }

let unknown = -1
let impossible = -2
let special = -3

(* The handlers that ran: one for each rule of a handler in the derivation, the innermost first. *)
let note_handlers t step (local : Local_step.t) =
  let of_handler = function
    | Rule.Watch_ignore | Watch_propagate | Watch_halt | Watch_retry | Watch_instead | Assert_err -> true
    | _ -> false
  in
  let settled = match local.derivation with Rule.Assert_err :: _ -> [] | rules -> List.filter of_handler rules in
  let rec note n (change : Task_rules.change) =
    match change.outcome with
    | Handling { handler; fault; propagated; _ } when n > 0 ->
      Coverage.run (Components.coverage t.components) handler.code;
      note (n - 1) (propagated fault)
    | Handling _ | Next _ | Finished | Failed _ -> ()
  in
  let change = Task_rules.broken (Components.escaping step) (Fault.make Fault.unknown_site "") in
  Option.iter (note (List.length settled)) change

(* The level at which the change stopped: an error leaves one nest after the other, each by PAR-ERR. *)
let level (local : Local_step.t) = List.length (List.filter (( = ) Rule.Par_err) local.derivation)

let program t = Components.program t.components
let world t = Components.world t.components

(* The environment's memory after the event, if the event can happen. *)
let outside_after t (Task_rules.Step { offer; _ }) event outside =
  match offer with
  | End_of (task, v) ->
    let is_it (event', _) = Transition.equal_event event event' in
    Option.map snd (List.find_opt is_it (Environment.task_ends (Components.options t.components) outside v task))
  | Recruit_for _ -> (
      match event with Transition.Recruited (_, v) -> Some (Environment.heard_of v outside) | _ -> Some outside)
  | Start _ | Perform _ | Check _ | Guard_false _ | Guard_either _ | Guard_values _ | Measure _ | Make _ | Allocate _
  | Expiry_of _ | Answer_to _ -> Some outside

type taken = { local : Local_step.t; level : int; certain : bool; assumed : World.assumption list list }

(* The effect of [step], and its level: several results, if it depends on sensor readings. *)
let taken ?(around = []) ?owed t step s =
  let { Surroundings.shared; outside } = Surroundings.Numbers.value (Encoding.shareds t.encoding) s in
  let shared =
    if (program t).asks_running then { shared with allocation = Residual.allocation_around around }
    else shared
  in
  let source = Task_rules.among around (Components.escaping ?owed step) in
  let take () =
    match step.event with
    | None -> Local_step.internal (program t) (world t) shared source
    | Some event -> Local_step.on_event (program t) (world t) shared source event
  in
  let after =
    match step.event with
    | None -> Some outside
    | Some event -> outside_after t step.source event outside
  in
  match after with
  | None -> ([], outside)
  | Some after ->
    let equal local local' = Int.equal (level local) (level local') && Local_step.equal local local' in
    let is_certain = function [ [] ] -> true | _ -> false in
    let one (assumed, local) = { local; level = level local; certain = is_certain assumed; assumed } in
    let decision = take () in
    (* Cases with one outcome may have run different handlers. *)
    let note (_, local) = Option.iter (note_handlers t step) local in
    List.iter note (Environment.clear (Decision.cases decision));
    (List.map one (Environment.clear (Decision.outcomes ~equal decision)), after)

let shared_after t (local : Local_step.t) outside =
  Surroundings.Numbers.number (Encoding.shareds t.encoding) (Surroundings.make local.after outside)

let grown xs length x =
  let longer = Array.make (max length (2 * Array.length xs)) x in
  Array.blit xs 0 longer 0 (Array.length xs);
  longer

let observed t local = match t.observe with None -> 0 | Some observe -> observe local

let guarded t step guard s =
  if s >= Array.length guard.results then begin
    guard.results <- grown guard.results (s + 1) unknown;
    if t.observe <> None then guard.actions <- grown guard.actions (s + 1) unknown
  end;
  if guard.results.(s) = unknown then
    guard.results.(s) <-
      (match taken t step s with
       | [], _ -> impossible
       | [ { local = { named = Check _ | Act _ | Cut _; _ } as local; certain = true; _ } ], outside ->
         if t.observe <> None then guard.actions.(s) <- observed t local;
         shared_after t local outside
       | _ :: _, _ -> special);
  guard.results.(s)

let is_settled t step s =
  match step.dependence with
  | Free -> true
  | Guarded guard -> guarded t step guard s >= 0
  | Dependent -> false

let action t step s =
  if step.free_action < 0 then
    step.free_action <- (match taken t step s with { local; _ } :: _, _ -> observed t local | [], _ -> 0);
  step.free_action

let unknown_outcome =
  { possible = false; certain = true; assumed = [ [] ]; shared = -1; action = 0; level = 0; target = Gone; rounds = [];
    others = [] }

let find ?around ?owed t step s =
  let found, outside = taken ?around ?owed t step s in
  let outcome others { local; level; certain; assumed } =
    let target =
      match local.outcome with
      | Goes_on r -> Components.landed t.components step level r
      | Over -> Gone
      | Ends ending -> Ends (Encoding.script_number t.encoding [] (Conclusion.ended local.after ending) outside)
    in
    let shared = shared_after t local outside and action = observed t local in
    Components.note_rounds t.components local.rounds;
    { possible = true; certain; assumed; shared; action; level; target; rounds = local.rounds; others }
  in
  match found with
  | [] -> { unknown_outcome with possible = false }
  | first :: rest -> outcome (List.map (outcome []) rest) first

(* For code that asks for running tasks: the answer, and the running tasks in each [watch]. *)
let running t around =
  if (program t).asks_running then
    let all = List.map fst (Vehicle_map.bindings (Residual.allocation_around around)) in
    all :: List.map (fun (lazy rs) -> List.concat_map Residual.running rs) (Residual.inside_watches around)
  else []

let number_owed t (owed : owed option) =
  match owed with
  | None -> 0
  | Some { inside; beside } -> (
      let all = inside :: beside in
      match Owed.find_opt t.owed all with
      | Some number -> number
      | None ->
        let number = 1 + Owed.length t.owed in
        Owed.add t.owed all number;
        number)

let surroundings t ?owed around =
  let needed =
    if Components.dismisses t.components then
      List.map Residual.needed_around (around :: Residual.beyond_watches around)
    else []
  in
  let needed = if (program t).recruits then Residual.named_around around :: needed else needed in
  let beside_watches = List.map Residual.held (Residual.beyond_watches around) in
  let held = Residual.held around and timers = Residual.timers_around around in
  let seen = (number_owed t owed, held, timers, beside_watches @ needed @ running t around) in
  match Hashtbl.find_opt t.seen seen with
  | Some number -> { around; owed; number }
  | None ->
    let number = Hashtbl.length t.seen in
    Hashtbl.add t.seen seen number;
    { around; owed; number }

let look t step { around; owed; number } s =
  let table =
    match step.looked with
    | Some table -> table
    | None ->
      let table = Hashtbl.create 16 in
      step.looked <- Some table;
      table
  in
  match Hashtbl.find_opt table (s, number) with
  | Some outcome -> outcome
  | None ->
    let outcome = find ~around ?owed t step s in
    Hashtbl.add table (s, number) outcome;
    outcome

let outcome t step s =
  if s >= Array.length step.outcomes then step.outcomes <- grown step.outcomes (s + 1) unknown_outcome;
  if step.outcomes.(s) == unknown_outcome then step.outcomes.(s) <- find t step s;
  step.outcomes.(s)

let ends_run outcome = match outcome.target with Ends _ -> true | Stays _ | Gone | Becomes _ -> false
