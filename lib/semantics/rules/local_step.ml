open Core

type event =
  | Vehicle_done of vehicle
  | Vehicle_failed of vehicle * string
  | Timer_expired of Residual.timer
  | Confirmed of Residual.timer * (bool, string) result
  | Recruited of Residual.timer * vehicle
  | Answered of { text : string; code : closure }
  | Nobody_answers of string
  | Replied of value
  | Host_failed of string
  | Input of string * value
  | Interruption

let equal_event a b =
  match a, b with
  | Vehicle_done v, Vehicle_done w -> String.equal v w
  | Vehicle_failed (v, why), Vehicle_failed (w, why') -> String.equal v w && String.equal why why'
  | Timer_expired n, Timer_expired n' -> Int.equal n n'
  | Confirmed (n, reply), Confirmed (n', reply') ->
    Int.equal n n' && Result.equal ~ok:Bool.equal ~error:String.equal reply reply'
  | Recruited (n, v), Recruited (n', w) -> Int.equal n n' && String.equal v w
  | Answered a, Answered b -> String.equal a.text b.text && Value.compare_closure a.code b.code = 0
  | Nobody_answers why, Nobody_answers why' | Host_failed why, Host_failed why' -> String.equal why why'
  | Replied x, Replied y -> Value.compare x y = 0
  | Input (k, x), Input (k', y) -> String.equal k k' && Value.compare x y = 0
  | Interruption, Interruption -> true
  | ( ( Vehicle_done _ | Vehicle_failed _ | Timer_expired _ | Confirmed _ | Recruited _ | Answered _ | Nobody_answers _
      | Replied _ | Host_failed _ | Input _ | Interruption ),
      _ ) -> false

type outcome = Goes_on of Residual.t | Over | Ends of Configuration.ending

type t = {
  after : Shared.t;
  outcome : outcome;
  derivation : Rule.t list;
  named : Label.t;
  asked : Effect.t list;
  rounds : Task_rules.round list;
}

let equal_outcome a b =
  match a, b with
  | Goes_on r, Goes_on r' -> Residual.equal r r'
  | Over, Over -> true
  | Ends e, Ends e' -> Configuration.compare_ending e e' = 0
  | (Goes_on _ | Over | Ends _), _ -> false

let equal a b = Label.equal a.named b.named && equal_outcome a.outcome b.outcome && Shared.equal a.after b.after

(* {1 Changes} *)

let without_tasks vs (s : Shared.t) =
  { s with allocation = List.fold_left (fun a v -> Vehicle_map.remove v a) s.allocation vs }

let released = function [] -> [] | vs -> [ Effect.Release vs ]

(* The vehicles that stop, and the effects: cut(r). *)
let undo : Task_rules.undoing -> vehicle list * Effect.t list = function
  | Cancel timer -> ([], [ Cancel_timer timer ])
  | Leave v -> ([], [ Release [ v ] ])
  | Forget _ | Do _ -> ([], [])
  | Cut cut ->
    let cancelled = List.map Effect.ceases (List.concat_map Residual.waits cut) in
    let stopped = List.concat_map Residual.running cut in
    let recruits = List.concat_map Residual.recruits cut in
    (stopped, cancelled @ List.map (fun v -> Effect.Stop v) stopped @ released recruits)

(* N and the variables after it. *)
let undone s : Task_rules.undoing -> Shared.t = function
  | Cancel _ | Leave _ -> s
  | Forget ns -> Shared.without_keys (List.map Residual.key ns) s
  | Do ds -> Shared.ensure ds s
  | Cut cut -> List.fold_left (fun s r -> Shared.ensure (Residual.ensured r) s) s cut

(* So deep are tasks in the place of those that failed. *)
let deepest = Maker.deepest

(* The task [t] that a handler gives, in the place of its own. *)
let instead (handler : Residual.handler) t propagated recovered =
  match handler.anew with
  | Some (_, request) when request.depth >= deepest ->
    let at = handler.code.lambda.lambda_site in
    propagated (Fault.make at (Printf.sprintf "tasks in the place of tasks that failed nest more than %d deep" deepest))
  | Some _ | None -> recovered (Task_rules.Instead t)

(* Code with [retry()] went by a variable to a handler that is not around it. *)
let foreign_retry (handler : Residual.handler) =
  Fault.make handler.code.lambda.lambda_site "retry() was called for another handler than that in whose text it stands"

(* A [watch] around a step: the vehicles held and needed outside of it, and those running inside of it. *)
type watch = { beside : vehicle list Lazy.t; needed : vehicle list Lazy.t; inside : vehicle list Lazy.t }

(* The vehicles held from the place of a step, and each [watch] around it, the innermost first. *)
type around = { held : vehicle list Lazy.t; watches : watch list Lazy.t }

let around_step around =
  let watch beyond inside =
    { beside = lazy (Residual.held beyond);
      needed = lazy (Residual.needed_around beyond);
      inside = lazy (List.concat_map Residual.running (Lazy.force inside)) }
  in
  let watches = lazy (List.map2 watch (Residual.beyond_watches around) (Residual.inside_watches around)) in
  { held = lazy (Residual.held around); watches }

let nothing = { beside = lazy []; needed = lazy []; inside = lazy [] }

(* The next [watch] has another [watch] inside. *)
let next_watch around =
  let watches = lazy (match Lazy.force around.watches with [] -> [] | _ :: outer -> outer) in
  ((match Lazy.force around.watches with [] -> nothing | first :: _ -> first), { around with watches })

(* [settle s derivation asked change] carries a change of the residual over to the shared part [s], handlers of errors
   included. [asked] are the effects so far. *)
let rec settle around program world s derivation asked (change : Task_rules.change) =
  let stopped, ceased = List.split (List.map undo change.undone) in
  let derivation = derivation @ change.rules in
  let s = without_tasks (List.concat stopped) s in
  let s = List.fold_left undone s change.undone in
  let s = Shared.without_keys (List.map Residual.key (Task_rules.keys_begun change)) s in
  let asked = asked @ List.concat ceased @ Conclusion.begun change.timers in
  let come_to outcome = { after = s; outcome; derivation; named = change.label; asked; rounds = change.rounds } in
  match change.outcome with
  | Next r -> Decision.Decided (come_to (Goes_on r))
  | Finished -> Decided (come_to Over)
  | Failed fault -> Decided (come_to (Ends (Failed fault)))
  | Handling { handler; fault; ignored; propagated; recovered } ->
    let { beside; needed; inside }, outer = next_watch around in
    (* The explorer takes steps of parts, whose changes do not know what they stop beside them. *)
    let s = if Vehicle_map.is_empty s.allocation then s else without_tasks (Lazy.force inside) s in
    let handled { Run_code.world; outcome; mode } =
      match outcome, mode with
      | Halts (message, s, deeds), _ ->
        let derivation = derivation @ [ Rule.Watch_halt ] and asked = asked @ Run_code.effects deeds in
        let ending = Ends (Halted message) in
        Decision.Decided { after = s; outcome = ending; derivation; named = change.label; asked; rounds = [] }
      | Faulty (fault, said), _ when Fault.is_assertion fault ->
        let asked = asked @ Run_code.effects said in
        Decided { (come_to (Ends (Failed fault))) with derivation = derivation @ [ Rule.Assert_err ]; asked }
      | Faulty (fault, said), _ ->
        settle outer program world s derivation (asked @ Run_code.effects said) (propagated fault)
      | Gives (Task t, s, deeds), Handler _ when handler.anew <> None ->
        let asked = asked @ Run_code.effects deeds in
        settle outer program world s derivation asked (instead handler t propagated recovered)
      | Gives (_, s, deeds), Handler Retried when handler.anew = None ->
        settle outer program world s derivation (asked @ Run_code.effects deeds) (propagated (foreign_retry handler))
      | Gives (_, s, deeds), Handler Retried ->
        settle outer program world s derivation (asked @ Run_code.effects deeds) (recovered Anew)
      | Gives (_, s, deeds), Handler Ignored ->
        settle outer program world s derivation (asked @ Run_code.effects deeds) (ignored ())
      | Gives (_, s, deeds), (Handler Propagated | Script | Task_code) ->
        settle outer program world s derivation (asked @ Run_code.effects deeds) (propagated fault)
    in
    Decision.bind (Run_code.handler ~held:beside ~needed program world s handler.code fault) handled

(* {1 Steps} *)

let kept program world local = { local with after = Run_code.kept program world local.after }

(* The time of the value [x] of the code of a [during] or [within]; [label] distinguishes these. *)
let seconds_of (code : closure) x =
  match Value.to_number x with
  | Some seconds when Time.is_one seconds -> Ok seconds
  | Some seconds when seconds >= 0. -> Error (Fault.make code.lambda.lambda_site (Time.none code.lambda.label seconds))
  | Some _ | None ->
    let message =
      Printf.sprintf "%s takes a time of 0 seconds or more, this code gives %s" code.lambda.label (Value.to_string x)
    in
    Error (Fault.make code.lambda.lambda_site message)

(* Code of a step: its value ([gives]) or its fault ([fails]), or the end of the program. Rules HALT and ASSERT-ERR
   are here, for code of every step. *)
let coded ?given held program world s code ~fails ~gives =
  let ends rule label ending s asked =
    let local = { after = s; outcome = Ends ending; derivation = [ rule ]; named = label; asked; rounds = [] } in
    Decision.Decided (Some (kept program world local))
  in
  let ran { Run_code.world; outcome; _ } =
    match outcome with
    | Faulty (fault, said) when Fault.is_assertion fault ->
      ends Assert_err (Broken fault.message) (Failed fault) s (Run_code.effects said)
    | Faulty (fault, said) -> fails world said fault
    | Halts (message, s, deeds) -> ends Halt (Halt message) (Halted message) s (Run_code.effects deeds)
    | Gives (x, s, deeds) -> gives world x s deeds
  in
  Decision.bind (Run_code.atomic ~held ?given program world s code) ran

(* [f] of a value, which must not be a reading. *)
let settled (code : closure) x f =
  match Reading.settled code.lambda.lambda_site x with Ok x -> f x | Error fault -> Decision.Unclear fault

(* {2 Tasks made at their turn} *)

(* Free vehicles for [task]; [None] if it waits for some. *)
let allocated world bound held opened task (request : Residual.request) around =
  let bound = bound @ Residual.recruited_for around in
  let from bound = Allocation.allocate_made world bound opened request task in
  let free = List.filter (fun v -> not (List.mem v (Lazy.force held))) bound in
  let waits_or_fails = function
    | Ok (_ : vehicle list * Residual.t) -> Ok None
    | Error fault -> Ok (Some (Error fault))
  in
  Result.bind (from free) (function
      | Ok found -> Ok (Some (Ok found))
      | Error fault when List.compare_lengths free bound = 0 -> Ok (Some (Error fault))
      | Error _ -> Result.bind (from bound) waits_or_fails)

let internal program world (s : Shared.t) (Task_rules.Step { offer; continue; around }) =
  let surroundings = around_step around in
  let held = surroundings.held in
  let coded ?given = coded ?given held in
  let go ?(asked = []) world s change =
    Decision.map (fun local -> Some (kept program world local)) (settle surroundings program world s [] asked change)
  in
  let fails continue world said fault = go world ~asked:(Run_code.effects said) s (continue (Error fault)) in
  let guard_fails continue world said fault =
    if Fault.is_unknown fault then Decision.Decided None else fails continue world said fault
  in
  let if_true guard continue =
    let gives world x s deeds =
      settled guard x (fun x ->
          if Value.truth x then go world ~asked:(Run_code.effects deeds) s (continue (Ok deeds)) else Decided None)
    in
    coded program world s guard ~gives ~fails:(guard_fails continue)
  in
  match offer with
  | End_of _ | Expiry_of _ | Answer_to _ | Recruit_for _ -> Decision.Decided None
  | Start (p, v) ->
    go world ~asked:[ Start (v, p) ] { s with allocation = Vehicle_map.add v p s.allocation } (continue ())
  | Perform code ->
    let gives world _ s deeds = go world ~asked:(Run_code.effects deeds) s (continue (Ok deeds)) in
    coded program world s code ~gives ~fails:(fails continue)
  | Check guard -> if_true guard continue
  | Guard_values guard -> if_true guard continue
  | Make (code, given, request) ->
    let gives world x after deeds =
      settled code x (fun x -> go world s (continue (Maker.task_of code given ~depth:request.depth s after x deeds)))
    in
    coded ~given program world s code ~gives ~fails:(fails continue)
  | Allocate (task, request) ->
    let used = lazy (Residual.timers_around around) in
    let numbers () = Residual.fresh_timers request.place (Lazy.force used) () in
    let opened = function
      | world, Error fault -> go world s (continue (Error fault))
      | world, Ok opened ->
        let look world =
          Result.map (fun found -> (world, found)) (allocated world s.bound held opened task request around)
        in
        let go_on = function
          | _, None -> Decision.Decided None
          | world, Some found -> go world s (continue found)
        in
        Decision.bind (Decision.look world look) go_on
    in
    Decision.bind (Maker.opened ~held program world s ~numbers ~depth:request.depth task) opened
  | Guard_false guard ->
    let gives world x _ _ =
      settled guard x (fun x ->
          if Value.truth x || Unknown.is x then Decision.Decided None else go world s (continue (Ok ())))
    in
    coded program world s guard ~gives ~fails:(guard_fails continue)
  | Guard_either guard ->
    let gives world x after deeds =
      settled guard x (fun x ->
          if Unknown.is x then Decision.Decided None
          else if Value.truth x then go world ~asked:(Run_code.effects deeds) after (continue (Ok (true, deeds)))
          else go world s (continue (Ok (false, []))))
    in
    coded program world s guard ~gives ~fails:(guard_fails continue)
  | Measure code ->
    let gives world x after deeds =
      settled code x (fun x ->
          match seconds_of code x with
          | Ok seconds -> go world ~asked:(Run_code.effects deeds) after (continue (Ok seconds))
          | Error fault -> fails continue world (Run_code.said deeds) fault)
    in
    coded program world s code ~gives ~fails:(fails continue)

(* Whether [v] may be recruited for [asked]. *)
let recruitable world s asked v surroundings =
  if List.mem v (Residual.named_around surroundings) then Decision.Decided false
  else Decision.look world (fun world -> Fit.fits world s asked v)

let on_event program world s (Task_rules.Step { offer; continue; around = surroundings }) (event : event) =
  let around = around_step surroundings in
  let go ?(asked = []) s change =
    Decision.map (fun local -> Some (kept program world local)) (settle around program world s [] asked change)
  in
  match event, offer with
  | Vehicle_done v, End_of (_, v') when v = v' -> go (without_tasks [ v ] s) (continue (Ok ()))
  | Vehicle_failed (v, why), End_of (_, v') when v = v' -> go (without_tasks [ v ] s) (continue (Error why))
  | Timer_expired timer, Expiry_of timer' when timer = timer' -> go s (continue ())
  | Confirmed (question, reply), Answer_to (question', _) when question = question' -> go s (continue reply)
  | Recruited (number, v), Recruit_for (number', asked) when number = number' ->
    let come = function
      | false -> Decision.Decided None
      | true -> go ~asked:[ Bind [ v ] ] s (continue v)
    in
    Decision.bind (recruitable world s asked v surroundings) come
  | ( ( Vehicle_done _ | Vehicle_failed _ | Timer_expired _ | Confirmed _ | Recruited _ | Answered _ | Nobody_answers _
      | Replied _ | Host_failed _ | Input _ | Interruption ),
      (Start _ | Perform _ | Check _ | Guard_false _ | Guard_either _ | Guard_values _ | Measure _ | Make _
      | Allocate _ | End_of _ | Expiry_of _ | Answer_to _ | Recruit_for _) ) ->
    Decided None

(* {1 In configurations} *)

let next m outcome shared : Configuration.t =
  match outcome with
  | Goes_on r -> { control = Executing (m, r); shared }
  | Over -> { control = Script (Machine.give Null m); shared = Shared.without_fresh shared }
  | Ends ending -> Conclusion.ended shared ending

(* An expired timer does not run any more, and an answered question is not open. *)
let without_spent on waits =
  match on with
  | Some (Timer_expired spent | Confirmed (spent, _)) -> List.filter (fun (number, _) -> number <> spent) waits
  | Some
      ( Vehicle_done _ | Vehicle_failed _ | Recruited _ | Answered _ | Nobody_answers _ | Replied _ | Host_failed _
      | Input _ | Interruption )
  | None -> waits

let conclude ?on m r { after; outcome; derivation; named; asked; rounds = _ } : Conclusion.t =
  let go_on rules : Conclusion.t =
    { rules; label = named; next = next m outcome after; effects = asked; assumed = [];
      otherwise = [] }
  in
  match outcome with
  | Goes_on _ -> go_on derivation
  | Over -> go_on (derivation @ [ Rule.Execute_done ])
  | Ends (Failed fault as ending) when not (Fault.is_assertion fault) ->
    (* The failure has cut off all that ran. *)
    Conclusion.ending ~before:asked (derivation @ [ Rule.Execute_err ]) named after ending
  | Ends ((Completed | Halted _ | Failed _ | Interrupted) as ending) ->
    let waits = without_spent on (Residual.waits r) in
    Conclusion.ending ~waits ~recruits:(Residual.recruits r) ~before:asked derivation named after ending
