open Dolphin_semantics
open Part
module Shareds = Interner.Make (Shared)

type t = { parts : Parts.t; shareds : Shareds.t }

let create parts = { parts; shareds = Shareds.create () }
let shareds t = t.shareds
let unknown = -1
let impossible = -2
let special = -3
let configuration shared = Shared.under (Ended Interrupted) shared

(* The handlers that ran: one for each rule of a handler in the derivation, the innermost first. *)
let note_handlers t step (local : Transition.local) =
  let of_handler = function Rule.Watch_ignore | Watch_propagate | Watch_halt | Assert_err -> true | _ -> false in
  let settled = match local.derivation with Rule.Assert_err :: _ -> [] | rules -> List.filter of_handler rules in
  let rec note n (change : Residual.change) =
    match change.outcome with
    | Handling { handler; fault; propagated; _ } when n > 0 ->
      Coverage.run (Parts.coverage t.parts) handler;
      note (n - 1) (propagated fault)
    | Handling _ | Next _ | Finished | Failed _ -> ()
  in
  note (List.length settled) ((fst (Climb.lifted step)).continue (Broke (Fault.make Fault.unknown_site "")))

let program t = Parts.program t.parts
let world t = Parts.world t.parts

let internal t step source shared =
  let local = Transition.local_internal (program t) (world t) (configuration shared) source in
  (match source.Residual.offer with
   | Perform _ | Check _ | Measure _ -> Option.iter (note_handlers t step) local
   | Start _ | End_of _ | Expiry_of _ -> ());
  (local, shared.Shared.outside)

let on_event t step (source : Residual.step) event shared =
  let take outside =
    let local = Transition.local_event (program t) (world t) (configuration shared) source event in
    Option.iter (note_handlers t step) local;
    (local, outside)
  in
  match source.offer with
  | End_of (task, v) -> (
      match List.assoc_opt event (Environment.task_ends (Parts.options t.parts) shared.Shared.outside v task) with
      | Some outside -> take outside
      | None -> (None, shared.outside))
  | Start _ | Perform _ | Check _ | Measure _ | Expiry_of _ -> take shared.outside

(* What [step] does, and at which level. *)
let taken t step s =
  let shared = Shareds.value t.shareds s and source, level = Climb.lifted step in
  let local, outside =
    match step.event with
    | None -> internal t step source shared
    | Some event -> on_event t step source event shared
  in
  (local, outside, !level)

let shared_after t (local : Transition.local) outside =
  Shareds.number t.shareds (Shared.of_configuration local.after outside)

let grown xs length x =
  let longer = Array.make (max length (2 * Array.length xs)) x in
  Array.blit xs 0 longer 0 (Array.length xs);
  longer

let guarded t step guard s =
  if s >= Array.length guard.results then guard.results <- grown guard.results (s + 1) unknown;
  if guard.results.(s) = unknown then
    guard.results.(s) <-
      (match taken t step s with
       | None, _, _ -> impossible
       | Some ({ named = Check _ | Act _ | Cut _; _ } as local), outside, _ -> shared_after t local outside
       | Some _, _, _ -> special);
  guard.results.(s)

let no_case = { possible = false; shared = -1; level = 0; result = Gone; whole = -1 }

let find t step s =
  match taken t step s with
  | None, _, _ -> { no_case with possible = false }
  | Some local, outside, level ->
    let result =
      match local.outcome with
      | Goes_on r -> Parts.landed t.parts step level r
      | Over -> Gone
      | Ends ending -> Ends ending
    in
    { possible = true; shared = shared_after t local outside; level; result; whole = -1 }

let case t step s =
  if s >= Array.length step.cases then step.cases <- grown step.cases (s + 1) no_case;
  if step.cases.(s) == no_case then step.cases.(s) <- find t step s;
  step.cases.(s)
