open Core

type timer = int

type t =
  | Ready of platform_task * vehicle
  | Running of platform_task * vehicle
  | Action of closure
  | Condition of closure
  | Sequence of t * t list
  | Parallel of t list
  | All_of of t option * branch list
  | One_of of branch list
  | Until of closure * t
  | Idle of { timer : timer; seconds : float }
  | During of { timer : timer; duration : duration; started : bool; body : t }
  | Watch of t * closure

and branch = { guard : closure; body : t }

(* {1 Order} *)

let rank = function
  | Ready _ -> 0 | Running _ -> 1 | Action _ -> 2 | Condition _ -> 3 | Sequence _ -> 4 | Parallel _ -> 5
  | All_of _ -> 6 | One_of _ -> 7 | Until _ -> 8 | Idle _ -> 9 | During _ -> 10 | Watch _ -> 11

let both first second = if first <> 0 then first else second ()

let rec compare r r' =
  if r == r' then 0
  else
    match r, r' with
    | Ready (p, v), Ready (p', v') | Running (p, v), Running (p', v') ->
      both (String.compare v v') (fun () -> Value.compare_task (Platform p) (Platform p'))
    | Action c, Action c' | Condition c, Condition c' -> Value.compare_closure c c'
    | Sequence (a, rest), Sequence (a', rest') ->
      both (compare a a') (fun () -> List.compare compare rest rest')
    | Parallel rs, Parallel rs' -> List.compare compare rs rs'
    | All_of (a, bs), All_of (a', bs') ->
      both (Option.compare compare a a') (fun () -> List.compare compare_branch bs bs')
    | One_of bs, One_of bs' -> List.compare compare_branch bs bs'
    | Until (c, a), Until (c', a') | Watch (a, c), Watch (a', c') ->
      both (Value.compare_closure c c') (fun () -> compare a a')
    | Idle a, Idle b -> both (Int.compare a.timer b.timer) (fun () -> Float.compare a.seconds b.seconds)
    | During a, During b ->
      both (Int.compare a.timer b.timer) (fun () ->
          both (Bool.compare a.started b.started) (fun () ->
              both (compare_duration a.duration b.duration) (fun () -> compare a.body b.body)))
    | ( ( Ready _ | Running _ | Action _ | Condition _ | Sequence _ | Parallel _ | All_of _ | One_of _ | Until _
        | Idle _ | During _ | Watch _ ),
        _ ) -> Int.compare (rank r) (rank r')

and compare_branch b b' = both (Value.compare_closure b.guard b'.guard) (fun () -> compare b.body b'.body)

and compare_duration d d' =
  match d, d' with
  | Seconds s, Seconds s' -> Float.compare s s'
  | Given_by c, Given_by c' -> Value.compare_closure c c'
  | Seconds _, Given_by _ -> -1
  | Given_by _, Seconds _ -> 1

let equal r r' = compare r r' = 0
let mix h k = (h * 65599) + k

let rec hash r =
  let h = rank r in
  match r with
  | Ready (p, v) | Running (p, v) -> mix (mix h (Hashtbl.hash v)) (Hashtbl.hash p.name)
  | Action c | Condition c -> mix h (Value.hash_closure c)
  | Sequence (a, rest) -> List.fold_left (fun h r -> mix h (hash r)) (mix h (hash a)) rest
  | Parallel rs -> List.fold_left (fun h r -> mix h (hash r)) h rs
  | All_of (a, bs) ->
    let h = match a with Some a -> mix h (hash a) | None -> h in
    List.fold_left (fun h b -> mix h (Value.hash_closure b.guard)) h bs
  | One_of bs -> List.fold_left (fun h b -> mix (mix h (Value.hash_closure b.guard)) (hash b.body)) h bs
  | Until (c, a) | Watch (a, c) -> mix (mix h (Value.hash_closure c)) (hash a)
  | Idle { timer; _ } -> mix h timer
  | During { timer; started; body; _ } -> mix (mix (mix h timer) (Bool.to_int started)) (hash body)

let rec pp ppf r =
  let separated text pp = Format.pp_print_list ~pp_sep:(fun ppf () -> Format.pp_print_string ppf text) pp in
  match r with
  | Ready (p, v) -> Format.fprintf ppf "%s[%s]" p.name v
  | Running (p, v) -> Format.fprintf ppf "%s[%s]..." p.name v
  | Action c -> Format.fprintf ppf "action { %s }" c.lambda.label
  | Condition c -> Format.fprintf ppf "condition { %s }" c.lambda.label
  | Sequence (a, rest) -> Format.fprintf ppf "(%a)" (separated " >> " pp) (a :: rest)
  | Parallel rs -> Format.fprintf ppf "(%a)" (separated " | " pp) rs
  | All_of (None, bs) -> Format.fprintf ppf "allOf { %a }" (separated ", " pp_branch) bs
  | All_of (Some a, bs) -> Format.fprintf ppf "allOf { %a; %a }" pp a (separated ", " pp_branch) bs
  | One_of bs -> Format.fprintf ppf "oneOf { %a }" (separated ", " pp_branch) bs
  | Until (c, a) -> Format.fprintf ppf "until { %s } run %a" c.lambda.label pp a
  | Idle { seconds; _ } -> Format.fprintf ppf "idle(%s)" (Value.amount seconds)
  | During { duration = Seconds s; body; _ } -> Format.fprintf ppf "during %s run %a" (Value.amount s) pp body
  | During { duration = Given_by c; body; _ } ->
    Format.fprintf ppf "during { %s } run %a" c.lambda.label pp body
  | Watch (a, _) -> Format.fprintf ppf "watch %a" pp a

and pp_branch ppf b = Format.fprintf ppf "when { %s } then %a" b.guard.lambda.label pp b.body

(* {1 Normal forms} *)

let parts = function Sequence (a, rest) -> a :: rest | r -> [ r ]

let sequence r r' =
  match r with
  | Sequence (a, rest) -> Sequence (a, rest @ parts r')
  | _ -> Sequence (r, parts r')

let of_parts = function
  | [] -> invalid_arg "Residual.of_parts"
  | [ r ] -> r
  | r :: rest -> Sequence (r, rest)

let parallel rs =
  let flat = List.concat_map (function Parallel rs -> rs | r -> [ r ]) rs in
  match flat with [] -> invalid_arg "Residual.parallel" | [ r ] -> r | flat -> Parallel flat

let all_of running remaining =
  match running, remaining with
  | Some r, [] -> r
  | None, [] -> invalid_arg "Residual.all_of"
  | None, [ last ] -> One_of [ last ]
  | (Some _ | None), remaining -> All_of (running, remaining)

let rec activate r =
  match r with
  | Ready _ | Running _ | Action _ | Condition _ | All_of (None, _) | One_of _ -> (r, [])
  | Idle { timer; seconds } -> (r, [ (timer, seconds) ])
  | Sequence (a, rest) ->
    let a, timers = activate a in
    (Sequence (a, rest), timers)
  | Parallel rs ->
    let rs, timers = List.split (List.map activate rs) in
    (Parallel rs, List.concat timers)
  | All_of (Some a, bs) ->
    let a, timers = activate a in
    (All_of (Some a, bs), timers)
  | Until (c, a) ->
    let a, timers = activate a in
    (Until (c, a), timers)
  | Watch (a, c) ->
    let a, timers = activate a in
    (Watch (a, c), timers)
  | During { duration = Given_by _; _ } -> (r, [])
  | During ({ duration = Seconds seconds; timer; body; _ } as d) ->
    let body, timers = activate body in
    (During { d with started = true; body }, (timer, seconds) :: timers)

(* {1 What is active} *)

(* [exists_active p r] is whether [p] holds of a node of [r] that has begun. *)
let rec exists_active p r =
  p r
  ||
  match r with
  | Ready _ | Running _ | Action _ | Condition _ | Idle _ | One_of _ | All_of (None, _) -> false
  | During { started = false; _ } -> false
  | Sequence (a, _) | All_of (Some a, _) | Until (_, a) | Watch (a, _) | During { body = a; _ } -> exists_active p a
  | Parallel rs -> List.exists (exists_active p) rs

let rec fold_active f acc r =
  let acc = f acc r in
  match r with
  | Ready _ | Running _ | Action _ | Condition _ | Idle _ | One_of _ | All_of (None, _) -> acc
  | During { started = false; _ } -> acc
  | Sequence (a, _) | All_of (Some a, _) | Until (_, a) | Watch (a, _) | During { body = a; _ } ->
    fold_active f acc a
  | Parallel rs -> List.fold_left (fold_active f) acc rs

let collect f r = List.rev (fold_active (fun found r -> match f r with Some x -> x :: found | None -> found) [] r)

let running = collect (function Running (_, v) -> Some v | _ -> None)

let timers =
  collect (function
      | Idle { timer; _ } | During { started = true; timer; _ } -> Some timer
      | _ -> None)

(* {1 Contexts} *)

type context =
  | Before of t list
  | Branch_of of branch list
  | Body_until of closure
  | Body_during of timer * duration
  | Watched_by of closure

let opened = function
  | Sequence (a, rest) -> Some (Before rest, a)
  | All_of (Some a, remaining) -> Some (Branch_of remaining, a)
  | Until (condition, a) -> Some (Body_until condition, a)
  | During { duration = Given_by _; started = false; _ } -> None
  | During { timer; duration; body; _ } -> Some (Body_during (timer, duration), body)
  | Watch (a, handler) -> Some (Watched_by handler, a)
  | Ready _ | Running _ | Action _ | Condition _ | Parallel _ | All_of (None, _) | One_of _ | Idle _ -> None

let within context r =
  match context, r with
  | Before rest, Sequence (a, before) -> Sequence (a, before @ rest)
  | Before rest, r -> Sequence (r, rest)
  | Branch_of remaining, r -> All_of (Some r, remaining)
  | Body_until condition, r -> Until (condition, r)
  | Body_during (timer, duration), body -> During { timer; duration; started = true; body }
  | Watched_by handler, r -> Watch (r, handler)

(* {1 Steps} *)

type offer =
  | Start of platform_task * vehicle
  | Perform of closure
  | Check of closure
  | Measure of closure
  | End_of of platform_task * vehicle
  | Expiry_of of timer

type undoing = Cancel of timer | Cut of t list
type reply = Went | Gave of float | Broke of Fault.t

type outcome =
  | Next of t
  | Finished
  | Failed of Fault.t
  | Handling of {
      handler : closure;
      fault : Fault.t;
      ignored : unit -> change;
      propagated : Fault.t -> change;
    }

and change = {
  outcome : outcome;
  rules : Rule.t list;
  timers : (timer * float) list;
  undone : undoing list;
}

type step = { offer : offer; continue : reply -> change }

let change rule outcome = { outcome; rules = [ rule ]; timers = []; undone = [] }

(* [enter rule r] is the change to [r], which begins now. *)
let enter rule around r =
  let r, timers = activate r in
  { (change rule (Next (around r))) with timers }

(* [settled ~went ~broke] continues a step that went, or broke with a fault. *)
let settled ~went ~broke = function
  | Went | Gave _ -> went ()
  | Broke fault -> broke fault

let failing rule fault = change rule (Failed fault)

(* What a step of a part is for the whole around it. *)
type around = {
  on_next : t -> change -> change;
  on_finished : change -> change;
  on_failed : Fault.t -> change -> change;
}

let add rule outcome change = { change with outcome; rules = change.rules @ [ rule ] }

let rec lift around change =
  match change.outcome with
  | Next r -> around.on_next r change
  | Finished -> around.on_finished change
  | Failed fault -> around.on_failed fault change
  | Handling h ->
    let ignored () = lift around (h.ignored ()) in
    let propagated fault = lift around (h.propagated fault) in
    { change with outcome = Handling { h with ignored; propagated } }

let step_within around step = { step with continue = (fun reply -> lift around (step.continue reply)) }

(* The usual whole: [next] rebuilds it, and it ends as its part ends. *)
let around ~next (step, finished, failed) =
  {
    on_next = (fun r c -> add step (Next (next r)) c);
    on_finished = (fun c -> add finished Finished c);
    on_failed = (fun fault c -> add failed (Failed fault) c);
  }

let around_sequence rest =
  let on_finished c =
    let next, timers = activate (of_parts rest) in
    { (add Rule.Seq_2 (Next next) c) with timers = c.timers @ timers }
  in
  { (around ~next:(fun r -> within (Before rest) r) (Rule.Seq_1, Rule.Seq_2, Rule.Seq_err)) with on_finished }

let around_parallel before after =
  let rebuild r = match r with Parallel rs -> Parallel (List.rev_append before (rs @ after))
                             | r -> Parallel (List.rev_append before (r :: after)) in
  {
    on_next = (fun r c -> add Rule.Par_1 (Next (rebuild r)) c);
    on_finished = (fun c -> add Rule.Par_2 (Next (parallel (List.rev_append before after))) c);
    on_failed =
      (fun fault c ->
         let others = Cut (List.rev_append before after) in
         { (add Rule.Par_err (Failed fault) c) with undone = c.undone @ [ others ] });
  }

let around_branch remaining =
  let next r = within (Branch_of remaining) r in
  {
    (around ~next (Rule.Allof_1, Rule.Allof_2, Rule.Allof_err)) with
    on_finished = (fun c -> add Rule.Allof_2 (Next (all_of None remaining)) c);
  }

let around_until condition =
  around ~next:(fun r -> within (Body_until condition) r) (Rule.Until_1, Rule.Until_2, Rule.Until_err)

let around_during timer duration =
  let next body = within (Body_during (timer, duration)) body in
  let cancel c = { c with undone = c.undone @ [ Cancel timer ] } in
  let plain = around ~next (Rule.During_1, Rule.During_2, Rule.During_err) in
  {
    plain with
    on_finished = (fun c -> cancel (plain.on_finished c));
    on_failed = (fun fault c -> cancel (plain.on_failed fault c));
  }

let around_watch handler =
  let on_failed fault c =
    let nothing rule outcome = { outcome; rules = [ rule ]; timers = []; undone = [] } in
    let ignored () = nothing Rule.Watch_ignore Finished in
    let propagated fault = nothing Rule.Watch_propagate (Failed fault) in
    { c with outcome = Handling { handler; fault; ignored; propagated } }
  in
  {
    (around ~next:(fun r -> within (Watched_by handler) r) (Rule.Watch_1, Rule.Watch_2, Rule.Watch_propagate)) with
    on_failed;
  }

let around_context = function
  | Before rest -> around_sequence rest
  | Branch_of remaining -> around_branch remaining
  | Body_until condition -> around_until condition
  | Body_during (timer, duration) -> around_during timer duration
  | Watched_by handler -> around_watch handler

let change_within context change = lift (around_context context) change

(* What a context can do to its body. *)
let cut context body =
  match context with
  | Before _ | Branch_of _ | Watched_by _ -> None
  | Body_until condition ->
    let went () = { (change Rule.Until_cut Finished) with undone = [ Cut [ body ] ] } in
    let broke fault = { (failing Rule.Until_err fault) with undone = [ Cut [ body ] ] } in
    Some { offer = Check condition; continue = settled ~went ~broke }
  | Body_during (timer, _) ->
    let cut = { (change Rule.During_cut Finished) with undone = [ Cut [ body ] ] } in
    Some { offer = Expiry_of timer; continue = (fun _ -> cut) }

let one step = Seq.return step

(* [each ~relevant f xs] is [f before x after] for each relevant [x] of [xs]; [before] is reversed. *)
let each ~relevant f xs =
  let rec from before xs () =
    match xs with
    | [] -> Seq.Nil
    | x :: after ->
      let rest = from (x :: before) after in
      if relevant x then Seq.append (f before x after) rest () else rest ()
  in
  from [] xs

(* The parts of a [|] in which no active node is [relevant] are passed over: there may be thousands. *)
let rec steps_at relevant r : step Seq.t =
  let steps = steps_at relevant in
  match r with
  | Ready (p, v) -> one { offer = Start (p, v); continue = (fun _ -> change Rule.Start (Next (Running (p, v)))) }
  | Running (p, v) ->
    let continue = settled ~went:(fun () -> change Rule.Done Finished) ~broke:(failing Rule.Fail) in
    one { offer = End_of (p, v); continue }
  | Action c ->
    let continue = settled ~went:(fun () -> change Rule.Action Finished) ~broke:(failing Rule.Action_err) in
    one { offer = Perform c; continue }
  | Condition c ->
    let continue = settled ~went:(fun () -> change Rule.Condition Finished) ~broke:(failing Rule.Condition_err) in
    one { offer = Check c; continue }
  | Parallel rs ->
    let part before r after = Seq.map (step_within (around_parallel before after)) (steps r) in
    each ~relevant:(exists_active relevant) part rs
  | All_of (None, branches) ->
    let choose before b after =
      let remaining = List.rev_append before after in
      let went () = enter Rule.Allof_when (fun r -> all_of (Some r) remaining) b.body in
      one { offer = Check b.guard; continue = settled ~went ~broke:(failing Rule.Allof_err) }
    in
    each ~relevant:(fun _ -> true) choose branches
  | One_of branches ->
    let choose _ b _ =
      let went () = enter Rule.Oneof_when Fun.id b.body in
      one { offer = Check b.guard; continue = settled ~went ~broke:(failing Rule.Oneof_err) }
    in
    each ~relevant:(fun _ -> true) choose branches
  | Idle { timer; _ } ->
    one { offer = Expiry_of timer; continue = (fun _ -> change Rule.Idle_end Finished) }
  | During { duration = Given_by c; started = false; timer; body } ->
    let began seconds =
      let body, timers = activate body in
      let next = During { timer; duration = Seconds seconds; started = true; body } in
      { (change Rule.During_set (Next next)) with timers = (timer, seconds) :: timers }
    in
    let continue = function
      | Gave seconds -> began seconds
      | Went -> began 0.
      | Broke fault -> failing Rule.During_err fault
    in
    one { offer = Measure c; continue }
  | Sequence _ | All_of (Some _, _) | Until _ | During _ | Watch _ -> (
      match opened r with
      | None -> Seq.empty
      | Some (context, body) -> (
          let inside = Seq.map (step_within (around_context context)) (steps body) in
          match cut context body with
          | None -> inside
          | Some cut -> fun () -> Seq.Cons (cut, inside)))

let steps = steps_at (fun _ -> true)

let may_step_alone = function
  | Running _ | Idle _ | During { duration = Seconds _; _ } | Sequence _ | Parallel _ | All_of (Some _, _) | Watch _ ->
    false
  | Ready _ | Action _ | Condition _ | All_of (None, _) | One_of _ | Until _ | During { duration = Given_by _; _ } ->
    true

let internal_steps = steps_at may_step_alone

let steps_of_vehicle v = steps_at (function Running (_, v') -> String.equal v v' | _ -> false)
