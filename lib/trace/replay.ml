open Dolphin_semantics
module Location = Dolphin_syntax.Location

type stuck = In of Residual.t | At of Core.site

type t = {
  program : Core.program;
  hash : string;  (* of its text *)
  places : bool;  (* whether the places of transitions refer to that text *)
  configuration : Configuration.t;
  world : World.t;
  transitions : int;
  time : float;
  event : Event.t option;  (* whose transition comes next *)
  stuck : stuck option;  (* the place where the run was stuck, if it was interrupted for that *)
  idle : bool;  (* the run was interrupted when it could do nothing by itself *)
  latest : (Transition.event option * Transition.t) option;  (* of the latest line, if that was a transition *)
  ending : Request.ending option;
}

let start ~hash program =
  { program; hash; places = true; configuration = Configuration.initial program; world = World.empty; transitions = 0;
    time = 0.; event = None; stuck = None; idle = false; latest = None; ending = None }

let configuration r = r.configuration
let world r = r.world
let transitions r = r.transitions
let time r = r.time
let ending r = r.ending
let latest r = r.latest
let stuck r = r.stuck
let was_stuck r = r.stuck <> None

let event r =
  let event event = Result.to_option (Event.to_event r.program r.configuration event) in
  Option.bind r.event event

(* {1 Mismatches} *)

type mismatch = {
  reason : string;
  false_guards : (Location.t * string) list;
  enabled : string list;
  awaited : string list;
}

let most_shown = 8

let rec first n (xs : 'a Seq.t) =
  if n = 0 then [] else match xs () with Seq.Nil -> [] | Seq.Cons (x, rest) -> x :: first (n - 1) rest

let show_label l = Format.asprintf "%a" Label.pp l

let enabled r =
  let shown = first (most_shown + 1) (Transition.internal r.program r.world r.configuration) in
  let labels = List.map (fun (t : Transition.t) -> show_label t.label) shown in
  if List.length labels > most_shown then List.filteri (fun i _ -> i < most_shown) labels @ [ "and more" ] else labels

let awaited r =
  let show : Transition.awaited -> string = function
    | End_of v -> Format.asprintf "%a" Event.pp (Done v)
    | Expiry_of timer -> Format.asprintf "%a" Event.pp (Timer timer)
    | Answer_to (_, prompt) -> Printf.sprintf "an answer to '%s'" prompt
    | Recruit_for (_, asked) -> Format.asprintf "a vehicle%a to recruit" Settings.pp_filter asked
    | Answer -> "an answer"
    | Reply -> "a reply of the host"
  in
  let events = Transition.awaited r.configuration in
  let shown = List.filteri (fun i _ -> i < most_shown) events in
  List.map show shown @ if List.length events > most_shown then [ "and more" ] else []

(* A check that is offered and not enabled is false. *)
let false_guards r =
  match r.configuration.control with
  | Script _ | Waiting _ | Ended _ -> []
  | Executing (m, residual) ->
    let located (c : Core.closure) =
      Option.map (fun at -> (at, c.lambda.label)) (Fault.location r.program (Fault.make c.lambda.lambda_site ""))
    in
    let if_false c =
      let alone = { r.configuration with control = Executing (m, Condition c) } in
      if Transition.internal r.program r.world alone () = Seq.Nil then located c else None
    in
    let is_false (Task_rules.Step { offer; _ }) =
      match offer with
      | Check c -> if_false c
      | Guard_values c -> if_false c
      | Start _ | Perform _ | Guard_false _ | Guard_either _ | Measure _ | Make _ | Allocate _ | End_of _ | Expiry_of _
      | Answer_to _ | Recruit_for _ -> None
    in
    first most_shown (Seq.filter_map is_false (Task_rules.marked_steps Alone residual))

let mismatch r reason =
  Error { reason; false_guards = false_guards r; enabled = enabled r; awaited = awaited r }

let pp_mismatch ppf m =
  let items name = function
    | [] -> Format.fprintf ppf "@,%s: nothing" name
    | xs -> Format.fprintf ppf "@,%s: %s" name (String.concat ", " xs)
  in
  Format.fprintf ppf "%s" m.reason;
  (match m.false_guards with
   | [] -> ()
   | guards ->
     let show (at, label) = Printf.sprintf "%s at %d:%d" label (Location.line at) (Location.column at) in
     items "false then" (List.map show guards));
  items "enabled then" m.enabled;
  items "awaited then" m.awaited

(* {1 Transitions} *)

(* [nth n p xs] is the [n]-th of [xs] of which [p] holds, from 0. *)
let rec nth n p (xs : 'a Seq.t) =
  match xs () with
  | Seq.Nil -> None
  | Seq.Cons (x, rest) -> if not (p x) then nth n p rest else if n = 0 then Some x else nth (n - 1) p rest

(* A pick may be met in more ways than can be listed: only the one that is meant is computed. *)
let picking r (step : Step.t) =
  let binding = List.find_map (function Request.Bind vs -> Some vs | _ -> None) step.requests in
  match binding with
  | None -> Seq.empty
  | Some vs ->
    let chosen = List.filter (fun (s : World.vehicle_state) -> List.mem s.id vs) (World.vehicles r.world) in
    let world = List.fold_left (fun w s -> World.add s w) World.empty chosen in
    fun () ->
      match Transition.internal r.program world r.configuration () with
      | Seq.Nil -> Seq.Nil
      | Seq.Cons (t, _) -> Seq.Cons (t, Seq.empty)

let candidates r (step : Step.t) =
  match r.configuration.control with
  | Waiting (_, Pick _) -> picking r step
  | Script _ | Waiting _ | Executing _ | Ended _ -> Transition.internal r.program r.world r.configuration

(* The name of a label, less what is in its parentheses. *)
let kind label = match String.index_opt label '(' with Some i -> String.sub label 0 i | None -> label

let no_transition r (step : Step.t) =
  let there = first most_shown (candidates r step) in
  let expected t = Step.of_transition r.program r.configuration t in
  let nearest = List.find_opt (fun t -> show_label t.Transition.label = step.label) there in
  let nearest =
    match nearest, there with
    | Some t, _ | None, [ t ] -> Some t
    | None, _ -> List.find_opt (fun (t : Transition.t) -> kind (show_label t.label) = kind step.label) there
  in
  let difference = Option.bind nearest (fun t -> Step.difference ~places:r.places (expected t) step) in
  match difference with
  | Some what -> mismatch r ("no transition is like this one; the nearest differs: " ^ what)
  | None when there = [] -> mismatch r (Printf.sprintf "nothing could happen by itself, so %s could not" step.label)
  | None -> mismatch r (Printf.sprintf "%s could not happen" step.label)

let moved r cause (t : Transition.t) =
  { r with configuration = t.next; transitions = r.transitions + 1; event = None; latest = Some (cause, t) }

let alone r (step : Step.t) =
  let fits (t : Transition.t) =
    String.equal (show_label t.label) step.label
    && Step.same ~places:r.places (Step.of_transition r.program r.configuration t) step
  in
  match nth step.choice fits (candidates r step) with
  | Some t -> Ok (moved r None t)
  | None -> no_transition r step

(* Earlier versions cancelled the timer that had just expired, and withdrew the question that had just been answered,
   where a handler ended the program. Their journals are read as if they had not. *)
let without_spent (t : Transition.t) event (step : Step.t) =
  let is_spent : Request.t -> bool = fun request ->
    match (event : Transition.event), request with
    | Timer_expired timer, Cancel_timer timer' -> timer = timer'
    | Confirmed (question, _), Withdraw_question question' -> question = question'
    | _, _ -> false
  in
  match t.next.control with
  | Ended _ -> { step with requests = List.filter (fun request -> not (is_spent request)) step.requests }
  | Script _ | Waiting _ | Executing _ -> step

let caused r (step : Step.t) event =
  let by = Format.asprintf "%a" Event.pp event in
  let refused : Transition.refusal -> _ = function
    | Not_awaited -> mismatch r (Printf.sprintf "%s makes no transition: it was not awaited" by)
    | Bad_answer why -> mismatch r (Printf.sprintf "%s makes no transition: %s" by why)
  in
  match Event.to_event r.program r.configuration event with
  | Error (No_value why) -> mismatch r (Printf.sprintf "%s is not an event: %s" by why)
  | Error (Refused why) -> refused why
  | Ok e -> (
      match Transition.accept r.program r.world r.configuration e with
      | Error why -> refused why
      | Ok t -> (
          let expected = Step.of_transition r.program r.configuration t in
          match Step.difference ~places:r.places expected (without_spent t e step) with
          | Some what -> mismatch r (Printf.sprintf "%s makes another transition: %s" by what)
          | None when step.choice > 0 ->
            mismatch r (Printf.sprintf "%s makes one transition, so it has no choice %d" by step.choice)
          | None ->
            (* A script always goes on; how, perhaps by a long allocation, does not matter. *)
            let is_left () =
              match r.configuration.control with
              | Script _ -> true
              | Waiting _ | Executing _ | Ended _ ->
                Transition.internal r.program r.world r.configuration () <> Seq.Nil
            in
            let idle = match event with Interruption _ -> r.idle || not (is_left ()) | _ -> r.idle in
            let stuck =
              match event, r.configuration.control with
              | Interruption { stuck = true }, Executing (_, residual) -> Some (In residual)
              | Interruption { stuck = true }, (Script _ | Waiting _) -> Some (At (Configuration.site r.configuration))
              | _, _ -> r.stuck
            in
            Ok { (moved r (Some e) t) with stuck; idle }))

(* {1 Lines} *)

let has_ended r = Configuration.has_ended r.configuration

(* Of rounds and loops without end it is not known whether there were as many as make a program stuck. *)
let ended_stuck r (ending : Configuration.ending) =
  let goes_round = match r.stuck with Some (In _) -> r.program.goes_round | Some (At _) -> true | None -> false in
  ending = Interrupted && (r.idle || goes_round)

let finish r transitions (ending : Request.ending) =
  match r.configuration.control with
  | Script _ | Waiting _ | Executing _ -> mismatch r "the run had not ended"
  | Ended its_ending ->
    let expected = Request.ending its_ending in
    if transitions <> r.transitions then
      mismatch r (Printf.sprintf "there were %d transitions, not %d" r.transitions transitions)
    else if ending = expected || (ending.how = "stuck" && ended_stuck r its_ending) then
      Ok { r with ending = Some ending }
    else mismatch r (Printf.sprintf "the run ended %s, not %s" expected.how ending.how)

let feed r (entry : Entry.t) =
  let time = match entry with Header _ -> r.time | entry -> Entry.time entry in
  if r.ending <> None then mismatch r "the journal goes on after its last line"
  else if time < r.time then mismatch r (Printf.sprintf "time goes back, from %g to %g" r.time time)
  else
    let r = { r with time; latest = None } in
    let r = if r.program.reads_now then { r with world = World.at (Exactly (World.whole time)) r.world } else r in
    match entry, r.event with
    | (Partial _ | Label _), _ -> mismatch r "such lines are those of a partial trace"
    | (Header _ | Vehicle _ | Event _ | Note _ | Act _ | Resumed _ | End _), Some event ->
      mismatch r (Format.asprintf "the transition on %a is missing" Event.pp event)
    | Header { program; order; place; begins; _ }, None ->
      let place = match r.program.place with Some _ as own -> own | None -> place in
      let begins = match begins with Some _ -> begins | None -> r.program.begins in
      Ok { r with places = program.hash = r.hash; world = World.nobody order;
                  program = { r.program with place; begins } }
    | Resumed { program; _ }, None -> Ok { r with places = program.hash = r.hash }
    | (Note _ | Act _), None -> Ok r
    | Vehicle { state; _ }, None -> Ok { r with world = World.add state r.world }
    | Event { event; _ }, None -> Ok { r with event = Some event }
    | Transition { index; step; _ }, event ->
      if index <> r.transitions then
        mismatch r (Printf.sprintf "transition %d is expected, not %d" r.transitions index)
      else if has_ended r then mismatch r "the run had ended"
      else (match event with None -> alone r step | Some event -> caused r step event)
    | End { transitions; ending; _ }, None -> finish r transitions ending
