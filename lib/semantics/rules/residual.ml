open Core

type timer = int

let script_timer = 0
let alarm = -1

type wait = Time of float | Answer of string
type begun = Wait of timer * wait | Key of timer

type t =
  | Ready of platform_task * vehicle
  | Running of platform_task * vehicle
  | Action of closure
  | Condition of closure
  | Sequence of t * t list
  | Parallel of t Branches.t
  | All_of of t option * branch list
  | One_of of branch list
  | Until of on_cut * closure * t
  | Idle of { timer : timer; seconds : float; site : site }
  | Confirm of { question : timer; prompt : string; site : site }
  | During of { on_cut : on_cut; timer : timer; duration : duration; started : bool; body : t }
  | Watch of t * handler
  | Repeat of { round : t option; again : again }
  | Made of { code : closure; given : value list; request : request }
  | Unallocated of { task : task; request : request }
  | Hold of vehicle list * t
  | Recruit of { number : timer; asked : Vehicle_filter.t; code : closure; place : timer; depth : int; site : site }
  | Recruited of vehicle * t
  | Fresh of timer list * t
  | Ensure of ensured list * t

and again = { left : int option; until : closure option; each : t; site : site }

and handler = { code : closure; anew : (task * request) option }

and branch = { guard : closure; body : t }

and request = { allowed : vehicle list option; place : timer; depth : int }

(* {1 Order} *)

let rank = function
  | Ready _ -> 0 | Running _ -> 1 | Action _ -> 2 | Condition _ -> 3 | Sequence _ -> 4 | Parallel _ -> 5
  | All_of _ -> 6 | One_of _ -> 7 | Until _ -> 8 | Idle _ -> 9 | During _ -> 10 | Watch _ -> 11 | Repeat _ -> 12
  | Made _ -> 13 | Unallocated _ -> 14 | Hold _ -> 15 | Confirm _ -> 16
  | Recruit _ -> 17 | Recruited _ -> 18 | Fresh _ -> 19 | Ensure _ -> 20

let rec compare r r' =
  if r == r' then 0
  else
    match r, r' with
    | Ready (p, v), Ready (p', v') | Running (p, v), Running (p', v') ->
      Order.both (String.compare v v') (fun () -> Value.compare_task (Platform p) (Platform p'))
    | Action c, Action c' | Condition c, Condition c' -> Value.compare_closure c c'
    | Sequence (a, rest), Sequence (a', rest') ->
      Order.both (compare a a') (fun () -> Order.list compare rest rest')
    | Parallel bs, Parallel bs' -> Order.list compare (Branches.to_list bs) (Branches.to_list bs')
    | All_of (a, bs), All_of (a', bs') ->
      Order.both (Option.compare compare a a') (fun () -> Order.list compare_branch bs bs')
    | One_of bs, One_of bs' -> Order.list compare_branch bs bs'
    | Until (e, c, a), Until (e', c', a') ->
      Order.both (Value.compare_on_cut e e') (fun () ->
          Order.both (Value.compare_closure c c') (fun () -> compare a a'))
    | Watch (a, h), Watch (a', h') -> Order.both (compare_handler h h') (fun () -> compare a a')
    | Idle a, Idle b -> Order.both (Int.compare a.timer b.timer) (fun () -> Float.compare a.seconds b.seconds)
    | Confirm a, Confirm b ->
      Order.both (Int.compare a.question b.question) (fun () ->
          Order.both (Int.compare a.site b.site) (fun () -> String.compare a.prompt b.prompt))
    | During a, During b ->
      Order.both (Int.compare a.timer b.timer) (fun () ->
          Order.both (Bool.compare a.started b.started) (fun () ->
              Order.both (compare_duration a.duration b.duration) (fun () ->
                  Order.both (Value.compare_on_cut a.on_cut b.on_cut) (fun () -> compare a.body b.body))))
    | Repeat a, Repeat b ->
      Order.both (Option.compare compare a.round b.round) (fun () -> compare_again a.again b.again)
    | Made a, Made b ->
      Order.both (Value.compare_closure a.code b.code) (fun () ->
          Order.both (Order.list Value.compare a.given b.given) (fun () -> compare_request a.request b.request))
    | Unallocated a, Unallocated b ->
      Order.both (Value.compare_task a.task b.task) (fun () -> compare_request a.request b.request)
    | Hold (vs, a), Hold (vs', a') ->
      Order.both (List.compare String.compare vs vs') (fun () -> compare a a')
    | Fresh (ns, a), Fresh (ns', a') -> Order.both (List.compare Int.compare ns ns') (fun () -> compare a a')
    | Ensure (ds, a), Ensure (ds', a') ->
      Order.both (Order.list Value.compare_ensured ds ds') (fun () -> compare a a')
    | Recruited (v, a), Recruited (v', a') -> Order.both (String.compare v v') (fun () -> compare a a')
    | Recruit a, Recruit b ->
      Order.both (Int.compare a.number b.number) (fun () ->
          Order.both (Int.compare a.place b.place) (fun () ->
              Order.both (Int.compare a.depth b.depth) (fun () ->
                  Order.both (Int.compare a.site b.site) (fun () ->
                      Order.both (Value.compare_closure a.code b.code) (fun () ->
                          Vehicle_filter.compare a.asked b.asked)))))
    | ( ( Ready _ | Running _ | Action _ | Condition _ | Sequence _ | Parallel _ | All_of _ | One_of _ | Until _
        | Idle _ | Confirm _ | During _ | Watch _ | Repeat _ | Made _ | Unallocated _ | Hold _ | Recruit _
        | Recruited _ | Fresh _ | Ensure _ ),
        _ ) -> Int.compare (rank r) (rank r')

and compare_branch b b' = Order.both (Value.compare_closure b.guard b'.guard) (fun () -> compare b.body b'.body)

and compare_handler h h' =
  if h == h' then 0
  else
    Order.both (Value.compare_closure h.code h'.code) (fun () ->
        let compare_anew (t, q) (t', q') = Order.both (compare_request q q') (fun () -> Value.compare_task t t') in
        Option.compare compare_anew h.anew h'.anew)

and compare_again a b =
  if a == b then 0
  else
    Order.both (Option.compare Int.compare a.left b.left) (fun () ->
        Order.both (Option.compare Value.compare_closure a.until b.until) (fun () ->
            Order.both (Int.compare a.site b.site) (fun () -> compare a.each b.each)))

and compare_request a b =
  Order.both (Int.compare a.place b.place) (fun () ->
      Order.both (Int.compare a.depth b.depth) (fun () ->
          Option.compare (List.compare String.compare) a.allowed b.allowed))

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
  | Parallel bs -> List.fold_left (fun h r -> Order.mix h (hash r)) h (Branches.to_list bs)
  | All_of (a, bs) ->
    let h = match a with Some a -> Order.mix h (hash a) | None -> h in
    List.fold_left (fun h b -> Order.mix h (Value.hash_closure b.guard)) h bs
  | One_of bs -> List.fold_left (fun h b -> Order.mix (Order.mix h (Value.hash_closure b.guard)) (hash b.body)) h bs
  | Until (_, c, a) | Watch (a, { code = c; _ }) -> Order.mix (Order.mix h (Value.hash_closure c)) (hash a)
  | Idle { timer; _ } -> Order.mix h timer
  | Confirm { question; prompt; _ } -> Order.mix (Order.mix h question) (Hashtbl.hash prompt)
  | During { timer; started; body; _ } -> Order.mix (Order.mix (Order.mix h timer) (Bool.to_int started)) (hash body)
  | Repeat { round; again = { left; each; _ } } ->
    let round = match round with Some r -> hash r | None -> 1 in
    Order.mix (Order.mix (Order.mix h round) (Option.value left ~default:0)) (hash each)
  | Made { code; given; request } ->
    let h = Order.mix (Order.mix h request.place) (Value.hash_closure code) in
    List.fold_left (fun h x -> Order.mix h (Value.hash x)) h given
  | Unallocated { task; request } -> Order.mix (Order.mix h request.place) (Value.hash (Task task))
  | Hold (vs, a) -> List.fold_left (fun h v -> Order.mix h (Hashtbl.hash v)) (Order.mix h (hash a)) vs
  | Recruit { number; code; _ } -> Order.mix (Order.mix h number) (Value.hash_closure code)
  | Recruited (v, a) -> Order.mix (Order.mix h (hash a)) (Hashtbl.hash v)
  | Fresh (ns, a) -> List.fold_left Order.mix (Order.mix h (hash a)) ns
  | Ensure (ds, a) -> List.fold_left (fun h d -> Order.mix h (Value.hash_ensured d)) (Order.mix h (hash a)) ds

(* {1 Keys} *)

let key_prefix = "#"
let key number = key_prefix ^ string_of_int number

let is_key k =
  let n = String.length key_prefix in
  String.length k > n
  && String.equal (String.sub k 0 n) key_prefix
  && String.for_all (function '0' .. '9' -> true | _ -> false) (String.sub k n (String.length k - n))

let rec pp ppf r =
  let separated text pp = Format.pp_print_list ~pp_sep:(fun ppf () -> Format.pp_print_string ppf text) pp in
  match r with
  | Ready (p, v) -> Format.fprintf ppf "%s[%s]" p.name v
  | Running (p, v) -> Format.fprintf ppf "%s[%s]..." p.name v
  | Action c -> Format.fprintf ppf "action { %s }" c.lambda.label
  | Condition c -> Format.fprintf ppf "condition { %s }" c.lambda.label
  | Sequence (a, rest) -> Format.fprintf ppf "(%a)" (separated " >> " pp) (a :: rest)
  | Parallel bs -> Format.fprintf ppf "(%a)" (separated " | " pp) (Branches.to_list bs)
  | All_of (None, bs) -> Format.fprintf ppf "allOf { %a }" (separated ", " pp_branch) bs
  | All_of (Some a, bs) -> Format.fprintf ppf "allOf { %a; %a }" pp a (separated ", " pp_branch) bs
  | One_of bs -> Format.fprintf ppf "oneOf { %a }" (separated ", " pp_branch) bs
  | Until (e, c, a) -> Format.fprintf ppf "%s { %s } run %a" (Value.until e) c.lambda.label pp a
  | Idle { seconds; _ } -> Format.fprintf ppf "idle(%s)" (Value.amount seconds)
  | Confirm { prompt; _ } -> Format.fprintf ppf "confirm(%a)" Value.pp (String prompt)
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
  | Made { code; _ } -> Format.fprintf ppf "{ %s }" code.lambda.label
  | Unallocated { task; _ } -> Format.fprintf ppf "unallocated %a" Value.pp (Task task)
  | Hold (vs, a) -> Format.fprintf ppf "holding %s %a" (String.concat ", " vs) pp a
  | Recruit { asked; code; _ } ->
    Format.fprintf ppf "recruit {%a } then { %s }" Settings.pp_filter asked code.lambda.label
  | Recruited (v, a) -> Format.fprintf ppf "recruited %s %a" v pp a
  | Fresh (ns, a) -> Format.fprintf ppf "fresh %s %a" (String.concat ", " (List.map key ns)) pp a
  | Ensure (ds, a) -> Format.fprintf ppf "%a ensure { %a }" pp a Value.pp_ensured ds

and pp_branch ppf b = Format.fprintf ppf "when { %s } then %a" b.guard.lambda.label pp b.body

(* {1 The view of a residual}

   [fold] and [map] list the constructors with the same parts; [test_parts] compares the two. *)

type leaf =
  | Plan of platform_task * vehicle
  | Code of closure
  | Handler of closure
  | Maker of closure
  | Given of value
  | Term of task
  | Held of vehicle
  | Timer of timer

let each f leaf xs acc = List.fold_left (fun acc x -> f acc (leaf x)) acc xs
let optional f x acc = match x with Some x -> f acc x | None -> acc

let fold_branches ~later ~leaf acc bs =
  List.fold_left (fun acc (b : branch) -> later (leaf acc (Code b.guard)) b.body) acc bs

let add_ensured leaf acc = function
  | Pair (_, x) | Variable (_, _, x) -> leaf acc (Given x)
  | Taken -> acc

let fold ~begun ~later ~leaf acc r =
  match r with
  | Ready (p, v) | Running (p, v) -> leaf acc (Plan (p, v))
  | Action c | Condition c -> leaf acc (Code c)
  | Sequence (a, rest) -> List.fold_left later (begun acc a) rest
  | Parallel bs -> List.fold_left begun acc (Branches.to_list bs)
  | All_of (None, bs) | One_of bs -> fold_branches ~later ~leaf acc bs
  | All_of (Some a, bs) -> fold_branches ~later ~leaf (begun acc a) bs
  | Until (_, c, a) -> begun (leaf acc (Code c)) a
  | Idle { timer; _ } | Confirm { question = timer; _ } -> leaf acc (Timer timer)
  | During { timer; duration; started; body; _ } ->
    let acc = leaf acc (Timer timer) in
    let acc = match duration with Seconds _ -> acc | Given_by c -> leaf acc (Code c) in
    if started then begun acc body else later acc body
  | Watch (a, { code; anew = None }) -> leaf (begun acc a) (Handler code)
  | Watch (a, { code; anew = Some (t, _) }) -> leaf (leaf (begun acc a) (Handler code)) (Term t)
  | Repeat { round; again = { until; each; _ } } ->
    let acc = match until with None -> acc | Some c -> leaf acc (Code c) in
    later (optional begun round acc) each
  | Made { code; given; _ } -> leaf acc (Maker code) |> each leaf (fun x -> Given x) given
  | Unallocated { task; _ } -> leaf acc (Term task)
  | Hold (vs, a) -> begun (each leaf (fun v -> Held v) vs acc) a
  | Recruit { number; code; _ } -> leaf (leaf acc (Timer number)) (Maker code)
  | Recruited (v, a) -> begun (leaf acc (Held v)) a
  | Fresh (ns, a) -> begun (each leaf (fun n -> Timer n) ns acc) a
  | Ensure (ds, a) -> begun (List.fold_left (add_ensured leaf) acc ds) a

type mapper = {
  part : t -> t;
  code : closure -> closure;
  handler : closure -> closure;
  maker : closure -> closure;
  value : value -> value;
  term : task -> task;
  vehicle : vehicle -> vehicle;
}

(* From left to right: a function may number what it meets. *)
let map m r =
  let request q = { q with allowed = Option.map (List.map m.vehicle) q.allowed } in
  let branch b =
    let guard = m.code b.guard in
    { guard; body = m.part b.body }
  in
  match r with
  | Ready (p, v) -> Ready (p, m.vehicle v)
  | Running (p, v) -> Running (p, m.vehicle v)
  | Action c -> Action (m.code c)
  | Condition c -> Condition (m.code c)
  | Sequence (a, rest) ->
    let a = m.part a in
    Sequence (a, List.map m.part rest)
  | Parallel bs -> Parallel (Branches.of_list (List.map m.part (Branches.to_list bs)))
  | All_of (a, bs) ->
    let a = Option.map m.part a in
    All_of (a, List.map branch bs)
  | One_of bs -> One_of (List.map branch bs)
  | Until (on_cut, c, a) ->
    let c = m.code c in
    Until (on_cut, c, m.part a)
  | Idle _ | Confirm _ -> r
  | During d ->
    let duration = match d.duration with Seconds s -> Seconds s | Given_by c -> Given_by (m.code c) in
    During { d with duration; body = m.part d.body }
  | Watch (a, h) ->
    let a = m.part a in
    let code = m.handler h.code in
    let renewed (t, q) =
      let t = m.term t in
      (t, request q)
    in
    Watch (a, { code; anew = Option.map renewed h.anew })
  | Repeat { round; again } ->
    let until = Option.map m.code again.until in
    let round = Option.map m.part round in
    Repeat { round; again = { again with until; each = m.part again.each } }
  | Made { code; given; request = q } ->
    let code = m.maker code in
    let given = List.map m.value given in
    Made { code; given; request = request q }
  | Unallocated { task; request = q } ->
    let task = m.term task in
    Unallocated { task; request = request q }
  | Hold (vs, a) ->
    let vs = List.map m.vehicle vs in
    Hold (vs, m.part a)
  | Recruit x -> Recruit { x with code = m.maker x.code }
  | Recruited (v, a) ->
    let v = m.vehicle v in
    Recruited (v, m.part a)
  | Fresh (ns, a) -> Fresh (ns, m.part a)
  | Ensure (ds, a) ->
    let ds = List.map (Task.map_ensured m.value) ds in
    Ensure (ds, m.part a)

let no_leaf acc (_ : leaf) = acc

let parts r =
  let add found r = r :: found in
  List.rev (fold ~begun:add ~later:add ~leaf:no_leaf [] r)

let fold_leaves f =
  let rec part acc r = fold ~begun:part ~later:part ~leaf:f acc r in
  part

let fold_all f =
  let rec part acc r = fold ~begun:part ~later:part ~leaf:no_leaf (f acc r) r in
  part

let fold_active f =
  let later acc _ = acc in
  let rec begun acc r = fold ~begun ~later ~leaf:no_leaf (f acc r) r in
  begun

(* {1 Marks of branches} *)

let marks_of_node r : Branches.mark list =
  match r with
  | Ready _ | Action _ | Condition _ | All_of (None, _) | One_of _ | Until _ | Made _ | Unallocated _
  | Repeat { round = None; _ } -> [ Alone ]
  | Running (_, v) -> [ End_on v ]
  | Idle { timer = n; _ } | Confirm { question = n; _ } | During { duration = Seconds _; timer = n; _ } -> [ Number n ]
  | During { duration = Given_by _; timer; _ } -> [ Alone; Number timer ]
  | Recruit { number; _ } -> [ Recruits; Number number ]
  | Sequence _ | Parallel _ | All_of (Some _, _) | Watch _ | Hold _ | Recruited _ | Fresh _ | Ensure _
  | Repeat { round = Some _; _ } -> []

let is_mark m r = List.exists (fun m' -> Branches.compare_marks m m' = 0) (marks_of_node r)

let rec awaits m r =
  match r with
  | Sequence (a, _) | Watch (a, _) | Hold (_, a) | Recruited (_, a) | Fresh (_, a) | Ensure (_, a)
  | Repeat { round = Some a; _ } -> awaits m a
  | Parallel bs -> (
      match Branches.marked awaits m bs () with Seq.Nil -> false | Cons _ -> true)
  | Ready _ | Running _ | Action _ | Condition _ | Idle _ | Confirm _ | One_of _ | All_of (None, _)
  | During { started = false; _ } | Made _ | Unallocated _ | Recruit _ | Repeat { round = None; _ } -> is_mark m r
  | All_of (Some a, _) | Until (_, _, a) | During { body = a; _ } -> is_mark m r || awaits m a

let marks r =
  let later found _ = found in
  let rec begun found r =
    let found = List.rev_append (marks_of_node r) found in
    match r with
    | Parallel bs when Branches.is_indexed bs -> Branches.Within :: (if awaits Alone r then Alone :: found else found)
    | _ -> fold ~begun ~later ~leaf:no_leaf found r
  in
  begun [] r

(* {1 Normal forms} *)

let successive = function Sequence (a, rest) -> a :: rest | r -> [ r ]

let sequence r r' =
  match r with
  | Sequence (a, rest) -> Sequence (a, rest @ successive r')
  | _ -> Sequence (r, successive r')

let parallel rs =
  let flat = List.concat_map (function Parallel bs -> Branches.to_list bs | r -> [ r ]) rs in
  match flat with
  | [] -> invalid_arg "Residual.parallel"
  | [ r ] -> r
  | flat -> Parallel (Branches.of_list flat)

let in_place place = function
  | Parallel bs -> Parallel (Branches.put ~marks place (Branches.to_list bs))
  | r -> Parallel (Branches.put ~marks place [ r ])

let without place =
  let bs = Branches.put ~marks place [] in
  match Branches.only bs with Some r -> r | None -> Parallel bs

let all_of running remaining =
  match running, remaining with
  | Some r, [] -> r
  | None, [] -> invalid_arg "Residual.all_of"
  | None, [ last ] -> One_of [ last ]
  | (Some _ | None), remaining -> All_of (running, remaining)

let repeat again round =
  match again.left with Some 0 -> round | Some _ | None -> Repeat { round = Some round; again }

let holding vs r = match vs with [] -> r | _ :: _ -> Hold (vs, r)
let ensuring ds r = match ds with [] -> r | _ :: _ -> Ensure (ds, r)

let rec activate r =
  match r with
  | Ready _ | Running _ | Action _ | Condition _ | All_of (None, _) | One_of _ | Made _ | Unallocated _
  | Recruit _ | Repeat { round = None; _ } -> (r, [])
  | Repeat { round = Some a; again } ->
    let a, timers = activate a in
    (Repeat { round = Some a; again }, timers)
  | Hold (vs, a) ->
    let a, timers = activate a in
    (Hold (vs, a), timers)
  | Recruited (v, a) ->
    let a, timers = activate a in
    (Recruited (v, a), timers)
  | Fresh (ns, a) ->
    let a, begun = activate a in
    (Fresh (ns, a), List.map (fun n -> Key n) ns @ begun)
  | Ensure (ds, a) ->
    let a, timers = activate a in
    (Ensure (ds, a), timers)
  | Idle { timer; seconds; _ } -> (r, [ Wait (timer, Time seconds) ])
  | Confirm { question; prompt; _ } -> (r, [ Wait (question, Answer prompt) ])
  | Sequence (a, rest) ->
    let a, timers = activate a in
    (Sequence (a, rest), timers)
  | Parallel bs ->
    let rs, timers = List.split (List.map activate (Branches.to_list bs)) in
    (Parallel (Branches.begun ~marks rs), List.concat timers)
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
    (During { d with started = true; body }, Wait (timer, Time seconds) :: timers)

(* {1 What is active} *)

let collect f r = List.rev (fold_active (fun found r -> match f r with Some x -> x :: found | None -> found) [] r)

let running = collect (function Running (_, v) -> Some v | _ -> None)

let waits =
  collect (function
      | Idle { timer; seconds; _ } | During { started = true; timer; duration = Seconds seconds; _ } ->
        Some (timer, Time seconds)
      | Confirm { question; prompt; _ } -> Some (question, Answer prompt)
      | _ -> None)

let site_of_timer number r =
  let site found r =
    match found, r with
    | None, (Idle { timer; site; _ } | During { started = true; timer; on_cut = Completes site | Fails site; _ })
      when timer = number -> Some site
    | _, _ -> found
  in
  fold_active site None r

let recruits = collect (function Recruited (v, _) -> Some v | _ -> None)

let ensures r = fold_all (fun found r -> found || match r with Ensure _ -> true | _ -> false) false r

(* From the inside out, and from left to right. *)
let ensured r =
  let later found _ = found in
  let rec add found r =
    let found = fold ~begun:add ~later ~leaf:no_leaf found r in
    match r with Ensure (ds, _) -> List.rev_append ds found | _ -> found
  in
  List.rev (add [] r)

(* The result of code is not known: it may be without end. *)
let may_go_round r =
  let makes found = function
    | Maker _ | Term _ -> true
    | Plan _ | Code _ | Handler _ | Given _ | Held _ | Timer _ -> found
  in
  let is_endless found = function Repeat { again = { left = None; _ }; _ } -> true | _ -> found in
  fold_leaves makes (fold_all is_endless false r) r

(* {1 Contexts} *)

type context =
  | In_sequence of t list
  | Branch_of of branch list
  | Body_until of on_cut * closure
  | Body_during of on_cut * timer * duration
  | In_watch of handler
  | Round_of of again
  | Holding of vehicle list
  | In_recruited of vehicle
  | With_keys of timer list
  | Ensuring of ensured list

let opened = function
  | Sequence (a, rest) -> Some (In_sequence rest, a)
  | All_of (Some a, remaining) -> Some (Branch_of remaining, a)
  | Until (on_cut, condition, a) -> Some (Body_until (on_cut, condition), a)
  | During { duration = Given_by _; started = false; _ } -> None
  | During { on_cut; timer; duration; body; _ } -> Some (Body_during (on_cut, timer, duration), body)
  | Watch (a, handler) -> Some (In_watch handler, a)
  | Repeat { round = Some a; again } -> Some (Round_of again, a)
  | Hold (vs, a) -> Some (Holding vs, a)
  | Recruited (v, a) -> Some (In_recruited v, a)
  | Fresh (ns, a) -> Some (With_keys ns, a)
  | Ensure (ds, a) -> Some (Ensuring ds, a)
  | Ready _ | Running _ | Action _ | Condition _ | Parallel _ | All_of (None, _) | One_of _ | Idle _ | Confirm _
  | Made _ | Unallocated _ | Recruit _ | Repeat { round = None; _ } -> None

let within context r =
  match context, r with
  | In_sequence rest, Sequence (a, before) -> Sequence (a, before @ rest)
  | In_sequence rest, r -> Sequence (r, rest)
  | Branch_of remaining, r -> All_of (Some r, remaining)
  | Body_until (on_cut, condition), r -> Until (on_cut, condition, r)
  | Body_during (on_cut, timer, duration), body -> During { on_cut; timer; duration; started = true; body }
  | In_watch handler, r -> Watch (r, handler)
  | Round_of again, r -> Repeat { round = Some r; again }
  | Holding vs, r -> Hold (vs, r)
  | In_recruited v, r -> Recruited (v, r)
  | With_keys ns, r -> Fresh (ns, r)
  | Ensuring ds, r -> Ensure (ds, r)

let decompose r =
  let rec from contexts r =
    match opened r with Some (context, body) -> from (context :: contexts) body | None -> (contexts, r)
  in
  from [] r

let plug contexts r = List.fold_left (fun r context -> within context r) r contexts

(* {1 What is held} *)

module Timer_set = Set.Make (Int)

let add_named =
  fold_leaves (fun found -> function
      | Plan (_, v) | Held v -> Vehicle_set.add v found
      | Code _ | Handler _ | Maker _ | Given _ | Term _ | Timer _ -> found)

let add_timers =
  fold_leaves (fun found -> function
      | Timer n -> Timer_set.add n found
      | Plan _ | Code _ | Handler _ | Maker _ | Given _ | Term _ | Held _ -> found)

let named r = Vehicle_set.elements (add_named Vehicle_set.empty r)

let makes_tasks =
  fold_leaves (fun found -> function
      | Maker _ | Term _ | Held _ -> true
      | Plan _ | Code _ | Handler _ | Given _ | Timer _ -> found) false

type surrounding = Beside of t list Lazy.t | Inside of context | Around of t list

let hole = Idle { timer = script_timer; seconds = 0.; site = Fault.unknown_site }

let held around =
  let beside found = function
    | Beside rs -> List.fold_left add_named found (Lazy.force rs)
    | Inside _ | Around _ -> found
  in
  Vehicle_set.elements (List.fold_left beside Vehicle_set.empty around)

let needed_around around =
  let add found = function
    | Beside rs -> List.fold_left add_named found (Lazy.force rs)
    | Inside (Holding _) | Around _ -> found
    | Inside context -> add_named found (within context hole)
  in
  Vehicle_set.elements (List.fold_left add Vehicle_set.empty around)

let named_around around =
  let add found = function
    | Beside rs -> List.fold_left add_named found (Lazy.force rs)
    | Around _ -> found
    | Inside context -> add_named found (within context hole)
  in
  Vehicle_set.elements (List.fold_left add Vehicle_set.empty around)

let recruited_for around =
  List.filter_map (function Inside (In_recruited v) -> Some v | Inside _ | Beside _ | Around _ -> None) around

let beyond_watches around =
  let rec from beyond = function
    | Inside (In_watch _) :: outer -> from (List.rev outer :: beyond) outer
    | (Inside _ | Beside _ | Around _) :: outer -> from beyond outer
    | [] -> List.rev beyond
  in
  from [] (List.rev around)

let inside_watches around =
  let rec from inside found = function
    | Inside (In_watch _) :: outer -> from inside (lazy (List.concat_map Lazy.force inside) :: found) outer
    | (Inside _ | Around _) :: outer -> from inside found outer
    | Beside rs :: outer -> from (rs :: inside) found outer
    | [] -> List.rev found
  in
  let own = function Around rs -> rs | Beside _ | Inside _ -> [] in
  from [ Lazy.from_val (List.concat_map own around) ] [] (List.rev around)

let allocation_around around =
  let run found = function Running (p, v) -> Vehicle_map.add v p found | _ -> found in
  let add found = function
    | Beside (lazy rs) | Around rs -> List.fold_left (fold_active run) found rs
    | Inside _ -> found
  in
  List.fold_left add Vehicle_map.empty around

let timers_around around =
  let add found = function
    | Beside rs -> List.fold_left add_timers found (Lazy.force rs)
    | Inside context -> add_timers found (within context hole)
    | Around _ -> found
  in
  Timer_set.elements (Timer_set.remove script_timer (List.fold_left add Timer_set.empty around))

(* {1 Numbers of timers} *)

let generation = 1_000_000

let fresh_timers place used =
  let rec from n () =
    let n = n + generation in
    if List.mem n used then from n () else Seq.Cons (n, from n)
  in
  from place
