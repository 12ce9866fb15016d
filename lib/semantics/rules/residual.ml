open Core

type timer = int

let script_timer = 0

type t =
  | Ready of platform_task * vehicle
  | Running of platform_task * vehicle
  | Action of closure
  | Condition of closure
  | Sequence of t * t list
  | Parallel of t list
  | All_of of t option * branch list
  | One_of of branch list
  | Until of on_cut * closure * t
  | Idle of { timer : timer; seconds : float }
  | During of { on_cut : on_cut; timer : timer; duration : duration; started : bool; body : t }
  | Watch of t * closure
  | Repeat of { round : t option; again : again }

and again = { left : int option; until : closure option; each : t; site : site }

and branch = { guard : closure; body : t }

(* {1 Order} *)

let rank = function
  | Ready _ -> 0 | Running _ -> 1 | Action _ -> 2 | Condition _ -> 3 | Sequence _ -> 4 | Parallel _ -> 5
  | All_of _ -> 6 | One_of _ -> 7 | Until _ -> 8 | Idle _ -> 9 | During _ -> 10 | Watch _ -> 11 | Repeat _ -> 12

let rec compare r r' =
  if r == r' then 0
  else
    match r, r' with
    | Ready (p, v), Ready (p', v') | Running (p, v), Running (p', v') ->
      Order.both (String.compare v v') (fun () -> Value.compare_task (Platform p) (Platform p'))
    | Action c, Action c' | Condition c, Condition c' -> Value.compare_closure c c'
    | Sequence (a, rest), Sequence (a', rest') ->
      Order.both (compare a a') (fun () -> Order.list compare rest rest')
    | Parallel rs, Parallel rs' -> Order.list compare rs rs'
    | All_of (a, bs), All_of (a', bs') ->
      Order.both (Option.compare compare a a') (fun () -> Order.list compare_branch bs bs')
    | One_of bs, One_of bs' -> Order.list compare_branch bs bs'
    | Until (e, c, a), Until (e', c', a') ->
      Order.both (Value.compare_on_cut e e') (fun () ->
          Order.both (Value.compare_closure c c') (fun () -> compare a a'))
    | Watch (a, c), Watch (a', c') -> Order.both (Value.compare_closure c c') (fun () -> compare a a')
    | Idle a, Idle b -> Order.both (Int.compare a.timer b.timer) (fun () -> Float.compare a.seconds b.seconds)
    | During a, During b ->
      Order.both (Int.compare a.timer b.timer) (fun () ->
          Order.both (Bool.compare a.started b.started) (fun () ->
              Order.both (compare_duration a.duration b.duration) (fun () ->
                  Order.both (Value.compare_on_cut a.on_cut b.on_cut) (fun () -> compare a.body b.body))))
    | Repeat a, Repeat b ->
      Order.both (Option.compare compare a.round b.round) (fun () -> compare_again a.again b.again)
    | ( ( Ready _ | Running _ | Action _ | Condition _ | Sequence _ | Parallel _ | All_of _ | One_of _ | Until _
        | Idle _ | During _ | Watch _ | Repeat _ ),
        _ ) -> Int.compare (rank r) (rank r')

and compare_branch b b' = Order.both (Value.compare_closure b.guard b'.guard) (fun () -> compare b.body b'.body)

and compare_again a b =
  if a == b then 0
  else
    Order.both (Option.compare Int.compare a.left b.left) (fun () ->
        Order.both (Option.compare Value.compare_closure a.until b.until) (fun () ->
            Order.both (Int.compare a.site b.site) (fun () -> compare a.each b.each)))

and compare_duration d d' =
  match d, d' with
  | Seconds s, Seconds s' -> Float.compare s s'
  | Given_by c, Given_by c' -> Value.compare_closure c c'
  | Seconds _, Given_by _ -> -1
  | Given_by _, Seconds _ -> 1

let equal r r' = compare r r' = 0
let rec hash r =
  let h = rank r in
  match r with
  | Ready (p, v) | Running (p, v) -> Order.mix (Order.mix h (Hashtbl.hash v)) (Hashtbl.hash p.name)
  | Action c | Condition c -> Order.mix h (Value.hash_closure c)
  | Sequence (a, rest) -> List.fold_left (fun h r -> Order.mix h (hash r)) (Order.mix h (hash a)) rest
  | Parallel rs -> List.fold_left (fun h r -> Order.mix h (hash r)) h rs
  | All_of (a, bs) ->
    let h = match a with Some a -> Order.mix h (hash a) | None -> h in
    List.fold_left (fun h b -> Order.mix h (Value.hash_closure b.guard)) h bs
  | One_of bs -> List.fold_left (fun h b -> Order.mix (Order.mix h (Value.hash_closure b.guard)) (hash b.body)) h bs
  | Until (_, c, a) | Watch (a, c) -> Order.mix (Order.mix h (Value.hash_closure c)) (hash a)
  | Idle { timer; _ } -> Order.mix h timer
  | During { timer; started; body; _ } -> Order.mix (Order.mix (Order.mix h timer) (Bool.to_int started)) (hash body)
  | Repeat { round; again = { left; each; _ } } ->
    let round = match round with Some r -> hash r | None -> 1 in
    Order.mix (Order.mix (Order.mix h round) (Option.value left ~default:0)) (hash each)

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
  | Until (e, c, a) -> Format.fprintf ppf "%s { %s } run %a" (Value.until e) c.lambda.label pp a
  | Idle { seconds; _ } -> Format.fprintf ppf "idle(%s)" (Value.amount seconds)
  | During { on_cut; duration = Seconds s; body; _ } ->
    Format.fprintf ppf "%s %s run %a" (Value.during on_cut) (Value.amount s) pp body
  | During { on_cut; duration = Given_by c; body; _ } ->
    Format.fprintf ppf "%s { %s } run %a" (Value.during on_cut) c.lambda.label pp body
  | Watch (a, _) -> Format.fprintf ppf "watch %a" pp a
  | Repeat { round; again = { left; until; each; _ } } ->
    let round ppf = match round with Some r -> Format.fprintf ppf "%a; " pp r | None -> () in
    let left = Option.fold left ~none:"" ~some:(Printf.sprintf "%d, ") in
    let until = Option.fold until ~none:"" ~some:(fun c -> Printf.sprintf " until { %s }" c.lambda.label) in
    Format.fprintf ppf "repeat (%t%s%a%s)" round left pp each until

and pp_branch ppf b = Format.fprintf ppf "when { %s } then %a" b.guard.lambda.label pp b.body

(* {1 Normal forms} *)

let parts = function Sequence (a, rest) -> a :: rest | r -> [ r ]

let sequence r r' =
  match r with
  | Sequence (a, rest) -> Sequence (a, rest @ parts r')
  | _ -> Sequence (r, parts r')

let parallel rs =
  let flat = List.concat_map (function Parallel rs -> rs | r -> [ r ]) rs in
  match flat with [] -> invalid_arg "Residual.parallel" | [ r ] -> r | flat -> Parallel flat

let all_of running remaining =
  match running, remaining with
  | Some r, [] -> r
  | None, [] -> invalid_arg "Residual.all_of"
  | None, [ last ] -> One_of [ last ]
  | (Some _ | None), remaining -> All_of (running, remaining)

let repeat again round =
  match again.left with Some 0 -> round | Some _ | None -> Repeat { round = Some round; again }

let rec activate r =
  match r with
  | Ready _ | Running _ | Action _ | Condition _ | All_of (None, _) | One_of _ | Repeat { round = None; _ } -> (r, [])
  | Repeat { round = Some a; again } ->
    let a, timers = activate a in
    (Repeat { round = Some a; again }, timers)
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
  | Until (on_cut, c, a) ->
    let a, timers = activate a in
    (Until (on_cut, c, a), timers)
  | Watch (a, c) ->
    let a, timers = activate a in
    (Watch (a, c), timers)
  | During { duration = Given_by _; _ } -> (r, [])
  | During ({ duration = Seconds seconds; timer; body; _ } as d) ->
    let body, timers = activate body in
    (During { d with started = true; body }, (timer, seconds) :: timers)

(* {1 What is active} *)

let rec exists_active p r =
  match r with
  | Sequence (a, _) | Watch (a, _) | Repeat { round = Some a; _ } -> exists_active p a
  | Parallel rs -> List.exists (exists_active p) rs
  | Ready _ | Running _ | Action _ | Condition _ | Idle _ | One_of _ | All_of (None, _) | During { started = false; _ }
  | Repeat { round = None; _ } -> p r
  | All_of (Some a, _) | Until (_, _, a) | During { body = a; _ } -> p r || exists_active p a

let rec fold_active f acc r =
  let acc = f acc r in
  match r with
  | Ready _ | Running _ | Action _ | Condition _ | Idle _ | One_of _ | All_of (None, _) -> acc
  | During { started = false; _ } | Repeat { round = None; _ } -> acc
  | Sequence (a, _) | All_of (Some a, _) | Until (_, _, a) | Watch (a, _) | During { body = a; _ }
  | Repeat { round = Some a; _ } -> fold_active f acc a
  | Parallel rs -> List.fold_left (fold_active f) acc rs

let collect f r = List.rev (fold_active (fun found r -> match f r with Some x -> x :: found | None -> found) [] r)

let running = collect (function Running (_, v) -> Some v | _ -> None)

let timers =
  collect (function
      | Idle { timer; _ } | During { started = true; timer; _ } -> Some timer
      | Ready _ | Running _ | Action _ | Condition _ | Sequence _ | Parallel _ | All_of _ | One_of _ | Until _
      | During { started = false; _ } | Watch _ | Repeat _ -> None)

let rec may_go_round r =
  match r with
  | Ready _ | Running _ | Action _ | Condition _ | Idle _ -> false
  | Sequence (a, rest) -> may_go_round a || List.exists may_go_round rest
  | Parallel rs -> List.exists may_go_round rs
  | All_of (a, bs) -> Option.fold a ~none:false ~some:may_go_round || List.exists (fun b -> may_go_round b.body) bs
  | One_of bs -> List.exists (fun b -> may_go_round b.body) bs
  | Until (_, _, a) | During { body = a; _ } | Watch (a, _) -> may_go_round a
  | Repeat { again = { left; each; _ }; _ } -> left = None || may_go_round each

(* {1 Contexts} *)

type context =
  | Before of t list
  | Branch_of of branch list
  | Body_until of on_cut * closure
  | Body_during of on_cut * timer * duration
  | Watched_by of closure
  | Round_of of again

let opened = function
  | Sequence (a, rest) -> Some (Before rest, a)
  | All_of (Some a, remaining) -> Some (Branch_of remaining, a)
  | Until (on_cut, condition, a) -> Some (Body_until (on_cut, condition), a)
  | During { duration = Given_by _; started = false; _ } -> None
  | During { on_cut; timer; duration; body; _ } -> Some (Body_during (on_cut, timer, duration), body)
  | Watch (a, handler) -> Some (Watched_by handler, a)
  | Repeat { round = Some a; again } -> Some (Round_of again, a)
  | Ready _ | Running _ | Action _ | Condition _ | Parallel _ | All_of (None, _) | One_of _ | Idle _
  | Repeat { round = None; _ } -> None

let within context r =
  match context, r with
  | Before rest, Sequence (a, before) -> Sequence (a, before @ rest)
  | Before rest, r -> Sequence (r, rest)
  | Branch_of remaining, r -> All_of (Some r, remaining)
  | Body_until (on_cut, condition), r -> Until (on_cut, condition, r)
  | Body_during (on_cut, timer, duration), body -> During { on_cut; timer; duration; started = true; body }
  | Watched_by handler, r -> Watch (r, handler)
  | Round_of again, r -> Repeat { round = Some r; again }

let decompose r =
  let rec from contexts r =
    match opened r with Some (context, body) -> from (context :: contexts) body | None -> (contexts, r)
  in
  from [] r

let plug contexts r = List.fold_left (fun r context -> within context r) r contexts
