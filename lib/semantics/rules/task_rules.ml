open Core
open Residual

(* {1 Steps} *)

type _ offer =
  | Start : platform_task * vehicle -> unit offer
  | Perform : closure -> (Code.deed list, Fault.t) result offer
  | Check : closure -> (Code.deed list, Fault.t) result offer
  | Guard_false : closure -> (unit, Fault.t) result offer
  | Guard_either : closure -> (bool * Code.deed list, Fault.t) result offer
  | Guard_values : closure -> (Code.deed list, Fault.t) result offer
  | Measure : closure -> (float, Fault.t) result offer
  | Make : closure * value list * request -> (task, Fault.t) result offer
  | Allocate : task * request -> (vehicle list * t, Fault.t) result offer
  | End_of : platform_task * vehicle -> (unit, string) result offer
  | Expiry_of : timer -> unit offer
  | Answer_to : timer * string -> (bool, string) result offer
  | Recruit_for : timer * Vehicle_filter.t -> vehicle offer

type undoing = Cancel of timer | Leave of vehicle | Forget of timer list | Do of ensured list | Cut of t list

type round = Endless of again | Asked of again | Retried of site

type recovery = Anew | Instead of task

type outcome =
  | Next of t
  | Finished
  | Failed of Fault.t
  | Handling of {
      handler : handler;
      fault : Fault.t;
      ignored : unit -> change;
      propagated : Fault.t -> change;
      recovered : recovery -> change;
    }

and change = {
  label : Label.t;
  outcome : outcome;
  rules : Rule.t list;
  timers : begun list;
  undone : undoing list;
  rounds : round list;
}

type step = Step : { offer : 'reply offer; continue : 'reply -> change; around : surrounding list } -> step

let keys_begun change = List.filter_map (function Key n -> Some n | Wait _ -> None) change.timers

let changes_shared change =
  let changes = function
    | Forget _ | Do _ -> true
    | Cut rs -> List.exists (fun r -> Residual.ensured r <> []) rs
    | Cancel _ | Leave _ -> false
  in
  keys_begun change <> [] || List.exists changes change.undone

let alone offer continue = Step { offer; continue; around = [] }

(* An axiom. *)
let change label rule outcome = { label; outcome; rules = [ rule ]; timers = []; undone = []; rounds = [] }

(* [enter label rule around r] is the change to [r], which begins now. *)
let enter label rule around r =
  let r, timers = activate r in
  { (change label rule (Next (around r))) with timers }

let broke rule (fault : Fault.t) = change (Broken fault.message) rule (Failed fault)
let undoing undone change = { change with undone = change.undone @ [ undone ] }

(* {1 Composition} *)

(* A change of a part as a change of the whole around it. *)
type around = {
  on_next : t -> change -> change;
  on_finished : change -> change;
  on_failed : Fault.t -> change -> change;
}

let add rule outcome change = { change with outcome; rules = change.rules @ [ rule ] }

(* [after_handling f c] is [c] with [f] applied to the changes after its handler, if there is one. *)
let after_handling f change =
  match change.outcome with
  | Next _ | Finished | Failed _ -> change
  | Handling h ->
    let ignored () = f (h.ignored ()) and propagated fault = f (h.propagated fault) in
    let recovered how = f (h.recovered how) in
    { change with outcome = Handling { h with ignored; propagated; recovered } }

let rec lift around change =
  match change.outcome with
  | Next r -> around.on_next r change
  | Finished -> around.on_finished change
  | Failed fault -> around.on_failed fault change
  | Handling _ -> after_handling (lift around) change

let with_change f (Step step) = Step { step with continue = (fun reply -> f (step.continue reply)) }

(* [s] as a step with the surroundings [around], which applies [f] to its changes. *)
let composed f surroundings (Step step) =
  let continue reply = f (step.continue reply) in
  Step { step with continue; around = List.rev_append surroundings step.around }

let among around (Step step) = Step { step with around = around @ step.around }

(* The usual whole: [next] rebuilds it, and it ends as its part ends. *)
let around ~next (step, finished, failed) =
  {
    on_next = (fun r c -> add step (Next (next r)) c);
    on_finished = (fun c -> add finished Finished c);
    on_failed = (fun fault c -> add failed (Failed fault) c);
  }

(* {2 One after the other} *)

let around_sequence rest =
  let on_finished c =
    let next = match rest with [ r ] -> r | r :: rest -> Sequence (r, rest) | [] -> invalid_arg "Task_rules: no part" in
    let next, timers = activate next in
    { (add Rule.Seq_2 (Next next) c) with timers = c.timers @ timers }
  in
  { (around ~next:(within (In_sequence rest)) (Rule.Seq_1, Rule.Seq_2, Rule.Seq_err)) with on_finished }

(* {2 Side by side} *)

let leave_parallel fault c = add Rule.Par_err (Failed fault) c

let around_parallel place =
  {
    on_next = (fun r c -> add Rule.Par_1 (Next (in_place place r)) c);
    on_finished = (fun c -> add Rule.Par_2 (Next (without place)) c);
    on_failed = (fun fault c -> undoing (Cut (Branches.beside place)) (leave_parallel fault c));
  }

(* {2 Branches with guards, until, during, watch} *)

let around_branch remaining =
  {
    (around ~next:(within (Branch_of remaining)) (Rule.Allof_1, Rule.Allof_2, Rule.Allof_err)) with
    on_finished = (fun c -> add Rule.Allof_2 (Next (all_of None remaining)) c);
  }

let around_until on_cut condition =
  around ~next:(within (Body_until (on_cut, condition))) (Rule.Until_1, Rule.Until_2, Rule.Until_err)

let around_during on_cut timer duration =
  let next = within (Body_during (on_cut, timer, duration)) in
  let plain = around ~next (Rule.During_1, Rule.During_2, Rule.During_err) in
  {
    plain with
    on_finished = (fun c -> undoing (Cancel timer) (plain.on_finished c));
    on_failed = (fun fault c -> undoing (Cancel timer) (plain.on_failed fault c));
  }

(* The task in the place of the one that failed has no vehicles yet. When it runs again, the handler watches it
   again. *)
let recover (handler : handler) label recovery =
  match recovery, handler.anew with
  | Anew, Some (task, request) ->
    let outcome = Next (Watch (Unallocated { task; request }, handler)) in
    { (change label Rule.Watch_retry outcome) with rounds = [ Retried handler.code.lambda.lambda_site ] }
  | Instead task, Some (_, request) ->
    let request = { request with depth = request.depth + 1 } in
    change label Rule.Watch_instead (Next (Unallocated { task; request }))
  | (Anew | Instead _), None -> invalid_arg "Task_rules: a handler that cannot recover"

let around_watch handler =
  let on_failed fault c =
    let ignored () = change c.label Rule.Watch_ignore Finished in
    let propagated fault = change c.label Rule.Watch_propagate (Failed fault) in
    let recovered = recover handler c.label in
    { c with outcome = Handling { handler; fault; ignored; propagated; recovered } }
  in
  { (around ~next:(within (In_watch handler)) (Rule.Watch_1, Rule.Watch_2, Rule.Watch_propagate)) with on_failed }

(* The next round begins, and with it its timers. *)
let next_round again next change =
  let round, timers = activate again.each in
  let outcome = Next (repeat { again with left = Option.map pred again.left } round) in
  let rounds = if again.left = None then change.rounds @ [ next ] else change.rounds in
  { change with outcome; timers = change.timers @ timers; rounds }

let around_round again =
  let on_finished c =
    match again.until with
    | None -> next_round again (Endless again) (add Rule.Repeat_2 Finished c)
    | Some _ -> add Rule.Repeat_2 (Next (Repeat { round = None; again })) c
  in
  { (around ~next:(within (Round_of again)) (Rule.Repeat_1, Rule.Repeat_2, Rule.Repeat_err)) with on_finished }

let around_hold vs =
  around ~next:(within (Holding vs)) (Rule.Hold_1, Rule.Hold_2, Rule.Hold_err)

let around_recruited v =
  let plain = around ~next:(within (In_recruited v)) (Rule.Recruit_1, Rule.Recruit_2, Rule.Recruit_err) in
  { plain with
    on_finished = (fun c -> undoing (Leave v) (plain.on_finished c));
    on_failed = (fun fault c -> undoing (Leave v) (plain.on_failed fault c)) }

let around_fresh ns =
  let plain = around ~next:(within (With_keys ns)) (Rule.Fresh_1, Rule.Fresh_2, Rule.Fresh_err) in
  { plain with
    on_finished = (fun c -> undoing (Forget ns) (plain.on_finished c));
    on_failed = (fun fault c -> undoing (Forget ns) (plain.on_failed fault c)) }

let around_ensure ds =
  let plain = around ~next:(within (Ensuring ds)) (Rule.Ensure_1, Rule.Ensure_2, Rule.Ensure_err) in
  { plain with
    on_finished = (fun c -> undoing (Do ds) (plain.on_finished c));
    on_failed = (fun fault c -> undoing (Do ds) (plain.on_failed fault c)) }

let around_context = function
  | Round_of again -> around_round again
  | In_sequence rest -> around_sequence rest
  | Branch_of remaining -> around_branch remaining
  | Body_until (on_cut, condition) -> around_until on_cut condition
  | Body_during (on_cut, timer, duration) -> around_during on_cut timer duration
  | In_watch handler -> around_watch handler
  | Holding vs -> around_hold vs
  | In_recruited v -> around_recruited v
  | With_keys ns -> around_fresh ns
  | Ensuring ds -> around_ensure ds

let change_within context change = lift (around_context context) change
let change_within_all contexts change = List.fold_left (fun c context -> change_within context c) change contexts

let rec escape nests beside change =
  match change.outcome with
  | Next _ | Finished -> change
  | Failed fault -> (
      let owed, further = match beside with [] -> ([], []) | owed :: further -> (owed, further) in
      let change = match owed with [] -> change | _ :: _ -> undoing (Do owed) change in
      match nests with
      | [] -> change
      | contexts :: outer -> escape outer further (change_within_all contexts (leave_parallel fault change)))
  | Handling _ -> after_handling (escape nests beside) change

let escaping ?(beside = []) nests step = with_change (escape nests beside) step

let not_assured (condition : closure) = Printf.sprintf "assure: { %s } does not hold" condition.lambda.label

let too_late = function
  | Seconds seconds -> Printf.sprintf "not done within %s s" (Value.amount seconds)
  | Given_by _ -> invalid_arg "Task_rules: a time that is not known yet"

(* The changes that a context can make to its body. *)
let cut context body =
  let cut change = undoing (Cut [ body ]) change in
  match context with
  | In_sequence _ | Branch_of _ | In_watch _ | Round_of _ | Holding _ | In_recruited _ | With_keys _ | Ensuring _ ->
    None
  | Body_until (Completes _, condition) ->
    let continue = function
      | Ok deeds -> cut (change (Label.Cut deeds) Rule.Until_cut Finished)
      | Error fault -> cut (broke Rule.Until_err fault)
    in
    Some (alone (Check condition) continue)
  | Body_until (Fails site, condition) ->
    let continue = function
      | Ok () -> cut (change (Label.Cut []) Rule.Assure_cut (Failed (Fault.make site (not_assured condition))))
      | Error fault -> cut (broke Rule.Until_err fault)
    in
    Some (alone (Guard_false condition) continue)
  | Body_during (on_cut, timer, duration) ->
    let rule, outcome =
      match on_cut with
      | Completes _ -> (Rule.During_cut, Finished)
      | Fails site -> (Rule.Within_cut, Failed (Fault.make site (too_late duration)))
    in
    let continue () = cut (change Label.Time_out rule outcome) in
    Some (alone (Expiry_of timer) continue)

let rec cuts contexts body =
  match contexts with
  | [] -> []
  | context :: outer ->
    let inside = List.map (fun context -> Inside context) outer in
    let further = composed (change_within_all outer) inside in
    Option.to_list (Option.map further (cut context body)) @ cuts outer (within context body)

(* {1 Steps of each operator} *)

let start p v =
  alone (Start (p, v)) (fun () -> change (Start (v, p.name)) Rule.Start (Next (Running (p, v))))

let await_end p v =
  let continue = function
    | Ok () -> change (Label.Done (v, p.name)) Rule.Done Finished
    | Error why ->
      let message = Printf.sprintf "%s failed on %s: %s" p.name v why in
      let fault = Fault.of_task p.task_site ~vehicle:v ~task:p.name message in
      change (Fail (v, p.name, why)) Rule.Fail (Failed fault)
  in
  alone (End_of (p, v)) continue

let perform code =
  let continue = function
    | Ok deeds -> change (Label.Act deeds) Rule.Action Finished
    | Error fault -> broke Rule.Action_err fault
  in
  alone (Perform code) continue

(* The step of [guard]: the change is [holds] of its label, or the error by rule [error]. *)
let check guard ~holds ~error =
  let continue = function
    | Ok deeds -> holds (Label.Check deeds)
    | Error fault -> broke error fault
  in
  alone (Check guard) continue

let wait_for guard =
  check guard ~holds:(fun label -> change label Rule.Condition Finished) ~error:Rule.Condition_err

(* The pairs that the guard took, in their order. *)
let taken deeds =
  let pairs : Code.deed -> (string * value) list = function
    | Consumed pairs -> pairs
    | Posted _ | Said _ | Released _ | Set_connection_timeout _ -> []
  in
  List.concat_map pairs deeds

let is_taken = function Taken -> true | Pair _ | Variable _ -> false

(* Whether the task of a branch depends on the pairs that its guard takes. *)
let rec uses_taken = function
  | Made made -> made.code.lambda.parameters > 0
  | Ensure (ds, r) -> List.exists is_taken ds || uses_taken r
  | _ -> false

let rec with_taken deeds = function
  | Made made when made.code.lambda.parameters > 0 -> Made { made with given = List.map snd (taken deeds) }
  | Ensure (ds, r) ->
    let given = function
      | Taken -> List.map (fun (k, x) -> Pair (k, x)) (taken deeds)
      | (Pair _ | Variable _) as d -> [ d ]
    in
    ensuring (List.concat_map given ds) (with_taken deeds r)
  | r -> r

(* The step of a branch, by rule [enters]: code in the place of its task, and [giveBack()], get the guard's pairs. *)
let choose (b : branch) around ~enters ~error =
  if uses_taken b.body then
    let continue = function
      | Ok deeds -> enter (Label.Check deeds) enters around (with_taken deeds b.body)
      | Error fault -> broke error fault
    in
    alone (Guard_values b.guard) continue
  else check b.guard ~holds:(fun label -> enter label enters around b.body) ~error

let choose_of_all before b after =
  let remaining = List.rev_append before after in
  choose b (fun r -> all_of (Some r) remaining) ~enters:Rule.Allof_when ~error:Rule.Allof_err

let choose_one b = choose b Fun.id ~enters:Rule.Oneof_when ~error:Rule.Oneof_err

let make code given request =
  let continue = function
    | Ok task ->
      let request = { request with depth = request.depth + 1 } in
      change Label.Make Rule.Make (Next (Unallocated { task; request }))
    | Error fault -> broke Rule.Make_err fault
  in
  alone (Make (code, given, request)) continue

let allocate task request =
  let continue = function
    | Ok (vs, r) -> enter (Label.Allocate vs) Rule.Allocate (holding vs) r
    | Error (fault : Fault.t) -> change (Cannot_execute fault.message) Rule.Allocate_err (Failed fault)
  in
  alone (Allocate (task, request)) continue

let ask_again again condition =
  let continue = function
    | Ok (true, deeds) -> change (Label.Check deeds) Rule.Repeat_until Finished
    | Ok (false, _) -> next_round again (Asked again) (change (Label.Check []) Rule.Repeat_again Finished)
    | Error fault -> broke Rule.Repeat_err fault
  in
  alone (Guard_either condition) continue

let idle_end timer =
  alone (Expiry_of timer) (fun () -> change Label.Time_out Rule.Idle_end Finished)

let await_answer question prompt site =
  let failed message = Failed (Fault.make site message) in
  let continue = function
    | Ok true -> change (Label.Answer "yes") Rule.Confirm_yes Finished
    | Ok false -> change (Answer "no") Rule.Confirm_no (failed (Printf.sprintf "'%s' was answered no" prompt))
    | Error why -> change No_answer Rule.Confirm_no (failed (Printf.sprintf "no answer to '%s': %s" prompt why))
  in
  alone (Answer_to (question, prompt)) continue

(* The task is made of the vehicle, for it alone. *)
let recruit number asked code place depth =
  let continue v =
    let request = { allowed = Some [ v ]; place; depth } in
    change (Label.Recruit v) Rule.Recruit (Next (Recruited (v, Made { code; given = [ Vehicles [ v ] ]; request })))
  in
  alone (Recruit_for (number, asked)) continue

let set_during on_cut timer code body =
  let continue = function
    | Error fault -> broke Rule.During_err fault
    | Ok seconds ->
      let body, timers = activate body in
      let next = During { on_cut; timer; duration = Seconds seconds; started = true; body } in
      { (change (Set_time seconds) Rule.During_set (Next next)) with timers = Wait (timer, Time seconds) :: timers }
  in
  alone (Measure code) continue

(* [every f xs] is [f before x after] for each [x] of [xs]; [before] is reversed. *)
let every f xs =
  let rec from before xs () =
    match xs with [] -> Seq.Nil | x :: after -> Seq.Cons (f before x after, from (x :: before) after)
  in
  from [] xs

(* The branches of a [|] without the mark are passed over: there may be thousands. *)
let rec steps_at (mark : Branches.mark option) r : step Seq.t =
  match r with
  | Ready (p, v) -> Seq.return (start p v)
  | Running (p, v) -> Seq.return (await_end p v)
  | Action code -> Seq.return (perform code)
  | Condition guard -> Seq.return (wait_for guard)
  | Parallel bs ->
    let branch (r, place) =
      let beside = Beside (lazy (Branches.beside place)) in
      Seq.map (composed (lift (around_parallel place)) [ beside ]) (steps_at mark r)
    in
    Seq.flat_map branch (match mark with None -> Branches.places bs | Some m -> Branches.marked awaits m bs)
  | All_of (None, branches) -> every choose_of_all branches
  | One_of branches -> every (fun _ b _ -> choose_one b) branches
  | Idle { timer; _ } -> Seq.return (idle_end timer)
  | Confirm { question; prompt; site } -> Seq.return (await_answer question prompt site)
  | During { on_cut; duration = Given_by code; started = false; timer; body } ->
    Seq.return (set_during on_cut timer code body)
  | Repeat { round = None; again = { until = Some condition; _ } as again } -> Seq.return (ask_again again condition)
  | Repeat { round = None; again = { until = None; _ } } -> invalid_arg "Task_rules: no condition to ask"
  | Made { code; given; request } -> Seq.return (make code given request)
  | Unallocated { task; request } -> Seq.return (allocate task request)
  | Recruit { number; asked; code; place; depth; site = _ } -> Seq.return (recruit number asked code place depth)
  | Sequence _ | All_of (Some _, _) | Until _ | During _ | Watch _ | Hold _ | Recruited _ | Fresh _
  | Ensure _ | Repeat { round = Some _; _ } -> (
      match opened r with
      | None -> Seq.empty
      | Some (context, body) -> (
          let inside = Seq.map (composed (change_within context) [ Inside context ]) (steps_at mark body) in
          match cut context body with
          | None -> inside
          | Some cut -> fun () -> Seq.Cons (cut, inside)))

let steps = steps_at None
let marked_steps m = steps_at (Some m)

let broken (Step { offer; continue; _ }) (fault : Fault.t) : change option =
  match offer with
  | Start _ | Recruit_for _ -> None
  | Expiry_of _ -> (
      let change = continue () in
      match change.outcome with Failed _ | Handling _ -> Some change | Next _ | Finished -> None)
  | Perform _ -> Some (continue (Error fault))
  | Check _ -> Some (continue (Error fault))
  | Guard_false _ -> Some (continue (Error fault))
  | Guard_either _ -> Some (continue (Error fault))
  | Guard_values _ -> Some (continue (Error fault))
  | Measure _ -> Some (continue (Error fault))
  | Make _ -> Some (continue (Error fault))
  | Allocate _ -> Some (continue (Error fault))
  | End_of _ -> Some (continue (Error fault.message))
  | Answer_to _ -> Some (continue (Error fault.message))
