open Dolphin_semantics

type ending = Succeeds | May_fail | Fails

module Names = Set.Make (String)

type input = { key : string; rounds : Core.value list list; times : int; certain : bool }

type options = {
  endings : Core.vehicle -> string -> ending;
  plans : string list;
  may_be_late : Core.vehicle -> bool;
  answers : string -> string list list;
  replies : string -> (Core.value, string) result list list;
  inputs : input list;
  faults : Faults.t;
  most_faults : int option;
  who_is_lost_matters : bool;
  recurring : World.assumption list list;
}

exception Unclear of Fault.t

let clear = function Ok x -> x | Error fault -> raise (Unclear fault)

let default =
  { endings = (fun _ _ -> Succeeds); plans = []; may_be_late = (fun _ -> true); answers = (fun _ -> []);
    replies = (fun _ -> []);
    inputs = []; faults = Faults.none; most_faults = None; who_is_lost_matters = true; recurring = [] }

let ending options v name =
  match options.endings v name, options.faults.fail with
  | (Fails | May_fail | Succeeds) as ending, Never -> ending
  | (Fails | May_fail | Succeeds) as ending, (At_most _ | Any_number) when options.most_faults = Some 0 -> ending
  | Fails, (At_most _ | Any_number) -> Fails
  | (May_fail | Succeeds), (At_most _ | Any_number) -> May_fail

let failing ?failures options =
  let fail = match failures with Some most -> Faults.At_most most | None -> Any_number in
  { options with faults = { options.faults with fail } }

let may_succeed options v name =
  match ending options v name with Succeeds | May_fail -> true | Fails -> false

let may_fail options v name =
  Faults.is_possible options.faults.loss
  || match ending options v name, options.faults.fail with
  | Succeeds, _ | May_fail, At_most 0 -> false
  | Fails, _ | May_fail, (Never | At_most _ | Any_number) -> true

(* {1 What the outside remembers} *)

(* Only bounded faults are counted, [asked] and [called] only as far as answers and replies depend on them: data
   without influence must not distinguish states. Vehicles, prompts and calls are in ascending order. *)
type memory = {
  failed : int;
  losses : int;
  spent : int;  (* faults of all kinds, with [most_faults] *)
  lost : Core.vehicle list;  (* and not heard of since *)
  late : Core.vehicle list;  (* those that were late, or missing, at some time *)
  asked : (string * int) list;  (* by prompt *)
  called : (string * int) list;  (* by name of the call *)
  sent : (int * int) list;  (* how often, by place among the inputs *)
}

type t = memory

let memory e = e
let of_memory e = e

let initial = { failed = 0; losses = 0; spent = 0; lost = []; late = []; asked = []; called = []; sent = [] }

let compare a b =
  let ( <?> ) first second = if first <> 0 then first else Lazy.force second in
  if a == b then 0
  else
    let compare_times (name, n) (name', n') = String.compare name name' <?> lazy (Int.compare n n') in
    let compare_times = List.compare compare_times in
    let compare_vehicles = List.compare String.compare in
    Int.compare a.failed b.failed
    <?> lazy (Int.compare a.losses b.losses)
    <?> lazy (Int.compare a.spent b.spent)
    <?> lazy (compare_vehicles a.lost b.lost)
    <?> lazy (compare_vehicles a.late b.late)
    <?> lazy (compare_times a.asked b.asked)
    <?> lazy (compare_times a.called b.called)
    <?> lazy (Stdlib.compare a.sent b.sent)

let hash e =
  let mix h x = (h * 31) + Hashtbl.hash x in
  let times h (_, n) = (h * 31) + n in
  let faults = (((e.failed * 7) + e.losses) * 7) + e.spent in
  let counted = List.fold_left times (List.fold_left times faults e.asked) e.called in
  let counted = List.fold_left (fun h (i, n) -> (h * 31) + (i * 7) + n) counted e.sent in
  List.fold_left mix (List.fold_left mix counted e.lost) e.late

let lost e = e.lost
let late e = e.late

(* Lost and late vehicles come first, then lost ones: so the order in which [f] meets them does not depend on their
   names, but among those with the same memory. *)
let renamed f e =
  let all vs = List.sort String.compare (List.map f vs) in
  let both = List.filter (fun v -> List.mem v e.late) e.lost in
  List.iter (fun v -> ignore (f v : Core.vehicle)) (both @ e.lost);
  { e with lost = all e.lost; late = all e.late }

let add v vs = List.sort_uniq String.compare (v :: vs)
let less v vs = List.filter (fun v' -> not (String.equal v v')) vs

(* {1 Counting faults} *)

let spent e = e.spent
let may_spend options e = Option.fold options.most_faults ~none:true ~some:(fun most -> e.spent < most)
let spend ?(faults = 1) options e = if options.most_faults = None then e else { e with spent = e.spent + faults }

(* How many vehicles of one run may be late, those that were late before included. *)
let join_limit options e : Faults.limit =
  let left most = List.length e.late + max 0 (most - e.spent) in
  match options.faults.join, options.most_faults with
  | limit, None -> limit
  | Never, Some _ -> Never
  | Any_number, Some most -> At_most (left most)
  | At_most n, Some most -> At_most (min n (left most))

let heard_of v e = if List.mem v e.lost then { e with lost = less v e.lost } else e

(* {1 Ends of tasks} *)

let failure = "failure"
let loss = "connection lost"
(* With counted losses, another loss of a lost vehicle does not count. *)
let endings_remember options =
  match options.faults.loss with
  | Never | At_most 0 -> false
  | At_most _ -> true
  | Any_number -> options.who_is_lost_matters || options.most_faults <> None

let forgetting_losses options = { options with who_is_lost_matters = false }

let task_ends options e v (p : Core.platform_task) : (Transition.event * t) list =
  let is_lost = List.mem v e.lost in
  let heard = if is_lost then { e with lost = less v e.lost } else e in
  let succeeded = (Transition.Vehicle_done v, heard) and failed e = (Transition.Vehicle_failed (v, failure), e) in
  let is_fault = options.endings v p.name = Succeeds in
  let failing e = [ succeeded; failed (if is_fault then spend options e else e) ] in
  let ends =
    match ending options v p.name, options.faults.fail with
    | Succeeds, _ -> [ succeeded ]
    | Fails, _ -> [ failed heard ]
    | May_fail, _ when is_fault && not (may_spend options e) -> [ succeeded ]
    | May_fail, (Never | Any_number) -> failing heard
    | May_fail, At_most most when e.failed < most -> failing { heard with failed = e.failed + 1 }
    | May_fail, At_most _ -> [ succeeded ]
  in
  let after_loss e = if endings_remember options then { e with lost = add v e.lost } else e in
  let lost e = [ (Transition.Vehicle_failed (v, loss), after_loss e) ] in
  match options.faults.loss with
  | _ when is_lost -> ends @ lost e
  | (Any_number | At_most _) when not (may_spend options e) -> ends
  | Any_number -> ends @ lost (spend options e)
  | At_most most when e.losses < most -> ends @ lost (spend options { e with losses = e.losses + 1 })
  | At_most _ | Never -> ends

(* {1 Answers and replies} *)

let times name counted = Option.value (List.assoc_opt name counted) ~default:0

(* The possible values this time, of [rounds] of which the last is for all later times. *)
let this_time name counted rounds =
  match List.length rounds with 0 -> [] | n -> List.nth rounds (min (times name counted) (n - 1))

(* [counted] after one more time, as far as [rounds] distinguish times. *)
let once_more name counted rounds =
  let n = times name counted + 1 in
  if n >= List.length rounds then counted
  else List.sort Stdlib.compare ((name, n) :: List.remove_assoc name counted)

let answered options program e prompt : ((Transition.event, Transition.refusal) result * t) list =
  let rounds = options.answers prompt in
  match this_time prompt e.asked rounds with
  | [] -> [ (Ok (Nobody_answers "none is given"), e) ]
  | texts ->
    let e = { e with asked = once_more prompt e.asked rounds } in
    List.map (fun text -> (Answer.event program text, e)) texts

(* Of a task's question: in which order answers are given is left open. *)
let confirmations options prompt : (bool, string) result list =
  match List.concat (options.answers prompt) with
  | [] -> [ Ok true; Ok false ]
  | texts -> (
      match List.sort_uniq (fun a b -> Bool.compare b a) (List.filter_map Answer.confirmation texts) with
      | [] -> [ Error "the fleet's answers are neither yes nor no" ]
      | found -> List.map Result.ok found)

let no_reply call = Format.asprintf "the fleet has no reply %a" Value.pp (String call)

let replied options e site call : ((Transition.event, Transition.refusal) result * t) list =
  let rounds = options.replies call in
  match this_time call e.called rounds with
  | [] -> [ (Ok (Host_failed (no_reply call)), e) ]
  | replies ->
    let e = { e with called = once_more call e.called rounds } in
    let event : _ -> (Transition.event, _) result = function
      | Ok x -> Ok (Replied (Value.made_at site x))
      | Error why -> Ok (Host_failed why)
    in
    List.map (fun reply -> (event reply, e)) replies

(* After an answer that was refused the question is asked again, [e] being remembered, and [before] when it was asked
   first. An empty text is absent. *)
let after_refusal options program ~before e (c : Configuration.t) why =
  match c.control with
  | Waiting (_, Ask prompt) when times prompt before.asked < List.length (options.answers prompt) - 1 ->
    answered options program e prompt
  | Waiting _ | Script _ | Executing _ | Ended _ -> [ (Ok (Transition.Nobody_answers why), e) ]

(* {1 Inputs} *)

(* Those that the program declares and that may still come, each with its place and how often it came. There may be
   thousands: they are gone through once, beside those that came. *)
let pending options (program : Core.program) e =
  let declared = Hashtbl.create 16 in
  let rec among i sent = function
    | [] -> Seq.Nil
    | input :: rest -> (
        match sent with
        | (j, n) :: later when i = j -> one i n input later rest
        | sent -> one i 0 input sent rest)
  and one i n input sent rest =
    if n < input.times && Hashtbl.mem declared input.key then
      Seq.Cons ((i, n, input), fun () -> among (i + 1) sent rest)
    else among (i + 1) sent rest
  in
  if options.inputs = [] || program.inputs = [] then Seq.empty
  else begin
    List.iter (fun k -> Hashtbl.replace declared k ()) program.inputs;
    fun () -> among 0 e.sent options.inputs
  end

let rec exists holds xs =
  match xs () with Seq.Nil -> false | Seq.Cons (x, rest) -> holds x || exists holds rest

let owes options program e = exists (fun (_, _, input) -> input.certain) (pending options program e)

let rec once_sent i n = function
  | (j, _) as other :: rest when j < i -> other :: once_sent i n rest
  | (j, _) :: rest when j = i -> (i, n + 1) :: rest
  | rest -> (i, n + 1) :: rest

(* The values that it may have now. *)
let round n input = List.nth input.rounds (min n (List.length input.rounds - 1))

let inputs options program e =
  let of_input (i, n, input) =
    let e = { e with sent = once_sent i n e.sent } in
    List.map (fun x -> (input.key, x, e)) (round n input)
  in
  List.concat_map of_input (List.of_seq (pending options program e))

let keys_of_inputs options program e =
  let add keys (_, _, input) = Names.add input.key keys in
  Names.elements (Seq.fold_left add Names.empty (pending options program e))

(* The pairs that may still come. *)
let upcoming options program e =
  let pairs (_, _, input) = List.concat_map (List.map (fun x -> (input.key, x))) input.rounds in
  List.concat_map pairs (List.of_seq (pending options program e))

(* {1 Events of real runs} *)

(* No loss is left of those that count for [vs]: what ends tasks of others is as before. *)
let without_contact vs (options, e) =
  if vs = [] then (options, e)
  else
    let loss, losses =
      match options.faults.loss with
      | Any_number -> (Faults.Any_number, e.losses)
      | Never -> (At_most 1, 1)
      | At_most n -> (At_most (n + 1), e.losses + 1)
    in
    ({ options with faults = { options.faults with loss } },
     { e with losses; lost = List.fold_left (fun lost v -> add v lost) e.lost vs })

let without_faults (options, e) =
  let fail = match options.faults.fail with At_most _ as limit -> limit | Never | Any_number -> Faults.Never in
  let options = { options with faults = { Faults.none with fail }; most_faults = Some 0 } in
  without_contact e.lost (options, { e with losses = 0; spent = 0; late = [] })

(* Of several inputs with one key, the first whose turn has this value. *)
let posted options program e k x =
  let after i n = { e with sent = once_sent i n e.sent } in
  let rec go first inputs =
    match inputs () with
    | Seq.Nil -> Option.value first ~default:e
    | Seq.Cons ((i, n, input), rest) when String.equal input.key k ->
      if List.exists (fun y -> Value.equals x y) (round n input) then after i n
      else go (if first = None then Some (after i n) else first) rest
    | Seq.Cons (_, rest) -> go first rest
  in
  go None (pending options program e)

let after options program (c : Configuration.t) (event : Transition.event) e =
  match event, c.control with
  | (Vehicle_done v | Recruited (_, v)), _ -> heard_of v e
  | (Answered _ | Nobody_answers _), Waiting (_, Ask prompt) ->
    { e with asked = once_more prompt e.asked (options.answers prompt) }
  | (Replied _ | Host_failed _), Waiting (_, Host_call { subject; member; _ }) ->
    let call = Machine.name_of_call ~subject ~member in
    { e with called = once_more call e.called (options.replies call) }
  | Input (k, x), _ -> posted options program e k x
  | (Answered _ | Nobody_answers _ | Replied _ | Host_failed _), (Script _ | Waiting _ | Executing _ | Ended _)
  | (Vehicle_failed _ | Timer_expired _ | Confirmed _ | Interruption), _ -> e

(* {1 Transitions} *)

let events options program world e (c : Configuration.t) (awaited : Transition.awaited) =
  match awaited, c.control with
  | End_of v, _ -> (
      match Vehicle_map.find_opt v c.shared.allocation with
      | Some p -> List.map (fun (event, e) -> (Ok event, e)) (task_ends options e v p)
      | None -> [])
  | Answer, Waiting (_, Ask prompt) -> answered options program e prompt
  | Reply, Waiting (_, Host_call { subject; member; _ }) ->
    replied options e (Configuration.site c) (Machine.name_of_call ~subject ~member)
  | Expiry_of timer, _ -> [ (Ok (Transition.Timer_expired timer), e) ]
  | Answer_to (question, prompt), _ ->
    List.map (fun reply -> (Ok (Transition.Confirmed (question, reply)), e)) (confirmations options prompt)
  | Recruit_for (number, _), _ ->
    let for_it : Transition.event -> bool = function Recruited (number', _) -> number = number' | _ -> false in
    let come (event : Transition.event) =
      (Ok event, match event with Recruited (_, v) -> heard_of v e | _ -> e)
    in
    List.of_seq (Seq.map come (Seq.filter for_it (Transition.recruitable program world c)))
  | (Answer | Reply), (Script _ | Waiting _ | Executing _ | Ended _) -> []

type choice = { transition : Transition.t; outside : t; on : Transition.event option }

(* Why some outcomes cannot be listed, once the others have been. *)
type unclear = Fault.t option ref

let note (unclear : unclear) fault = if !unclear = None then unclear := Some fault

let internal ~unclear program world e c : choice Seq.t =
  let by_itself transition = { transition; outside = e; on = None } in
  fun () ->
    let listed, fault = Transition.internal_listed program world c in
    Option.iter (note unclear) fault;
    Seq.map by_itself listed ()

let in_world ~unclear options program world e c : choice Seq.t =
  let rec accept before (event, e) =
    let of_result on : _ -> choice list = function
      | Ok transition -> [ { transition; outside = e; on } ]
      | Error Transition.Not_awaited -> []
      | Error (Bad_answer why) -> List.concat_map (accept e) (after_refusal options program ~before e c why)
    in
    match event with
    | Ok event -> (
        match Transition.accept_all program world c event with
        | Ok accepted -> List.concat_map (of_result (Some event)) accepted
        | Error fault -> note unclear fault; [])
    | Error refusal -> of_result None (Error refusal)
  in
  let on_event event = List.to_seq (List.concat_map (accept e) (events options program world e c event)) in
  Seq.append (internal ~unclear program world e c) (Seq.flat_map on_event (List.to_seq (Transition.awaited c)))

(* {1 Who is there} *)

(* The ways to have too few vehicles differ in the text only, and in the late vehicles, which matters if anything
   follows: of those with more the ones with fewer are enough. Other transitions come twice only where sensors are
   open. *)
let once world (pick : Settings.pick) choices () =
  let too_few_came = ref [] in
  let is_first { transition; outside; _ } =
    match transition.label with
    | No_vehicles _ ->
      let is_enough e = (not pick.otherwise) || List.for_all (fun v -> List.mem v outside.late) e.late in
      let seen = List.exists is_enough !too_few_came in
      if not seen then too_few_came := outside :: !too_few_came;
      not seen
    | _ -> true
  in
  let choices = Seq.filter is_first choices in
  if World.is_open world then Transition.distinct (fun c -> c.transition) choices () else choices ()

(* The assumptions about those vehicles that are never among the first [n] of the remaining ones of their class: they
   are seen outside of the region, so that what holds then holds of [world]; or are missing, where they never are.
   Then the first [n] of theirs are within it, and the pick does not fail. *)
let hidden alike n world (pick : Settings.pick) bound =
  let seen = Hashtbl.create 8 and bound = Vehicle_set.of_list bound in
  let is_hidden (s : World.vehicle_state) =
    match alike s.id with
    | Some c when Settings.accepts { pick.filter with region = None } s && not (Vehicle_set.mem s.id bound) ->
      let before = Option.value (Hashtbl.find_opt seen c) ~default:0 in
      Hashtbl.replace seen c (before + 1);
      before >= n
    | Some _ | None -> false
  in
  let hide (s : World.vehicle_state) =
    let outside area p = not (Dolphin_geo.Area.contains area p) in
    match pick.filter.region, World.position world s with
    | Some area, Shows p when outside area p -> []
    | Some area, One_of ps when List.exists (outside area) ps -> [ World.Placed (s.id, List.find (outside area) ps) ]
    | _ -> [ Missing s.id ]
  in
  List.concat_map hide (List.filter is_hidden (World.vehicles world))

let assuming assumed choice =
  let t = choice.transition in
  let otherwise = List.map (fun other -> assumed @ other) t.otherwise in
  { choice with transition = { t with assumed = assumed @ t.assumed; otherwise } }

let picking ?alike ?binding ~unclear options program world e (c : Configuration.t) (pick : Settings.pick) =
  let join = join_limit options e in
  let company_in world =
    Attendance.company ?alike ?only:binding { options.faults with join } ~may_be_late:options.may_be_late
      ~lost:e.lost ~late:e.late ~bound:c.shared.bound world pick
  in
  let company = company_in world in
  let remember (a : Attendance.t) { transition; outside = e; on } =
    let is_picked v = List.mem v transition.next.shared.bound && not (List.mem v c.shared.bound) in
    let lost = List.filter (fun v -> not (is_picked v)) e.lost in
    let noted = List.filter (fun v -> List.mem v (Attendance.unsure company)) (a.coming @ a.missing) in
    let noted = match join with At_most _ -> noted | Never | Any_number -> [] in
    let late = List.fold_left (fun vs v -> add v vs) e.late noted in
    let faults = List.length late - List.length e.late in
    { transition; on; outside = spend ~faults options { e with lost; late } }
  in
  let assumed (a : Attendance.t) =
    List.map (fun v -> World.Late v) a.coming @ List.map (fun v -> World.Missing v) a.missing
  in
  let given a transitions =
    let assumed = assumed a in
    Seq.map (fun choice -> remember a (assuming assumed choice)) transitions
  in
  let too_few n =
    let ways = Attendance.too_few company n in
    let remembered = match join with At_most _ -> pick.otherwise | Never | Any_number -> false in
    if remembered then ways else match ways () with Seq.Nil -> Seq.empty | Seq.Cons (way, _) -> Seq.return way
  in
  let attended_in world a = given a (in_world ~unclear options program (World.suppose (assumed a) world) e c) in
  let attended = attended_in world in
  let of_number n =
    let hidden = Option.fold ~none:[] ~some:(fun alike -> hidden alike n world pick c.shared.bound) alike in
    let shown = World.suppose hidden world in
    let placed = List.filter (function World.Placed _ -> true | _ -> false) hidden in
    let seen = if hidden = [] then company else company_in shown in
    (* Without a vehicle that may be missing, a pick fails only if fewer than [n] fit: [n] that fit stand for all. *)
    let enough = function [] -> Attendance.first_always company n | vs -> Some vs in
    let with_only vs =
      let ids = List.map (fun (s : World.vehicle_state) -> s.id) (World.vehicles shown) in
      World.only (List.filter (fun v -> List.mem v vs) ids) shown
    in
    let shown = Option.fold (Option.bind binding enough) ~none:shown ~some:with_only in
    fun news ->
      let bound (on_time, coming) =
        given { coming; missing = [] } (internal ~unclear program (World.only (on_time @ coming) world) e c)
      in
      let failed missing =
        if Attendance.number_of_new company missing = news then attended { coming = []; missing } else Seq.empty
      in
      let as_it_is = if news = 0 then attended_in shown { coming = []; missing = [] } else Seq.empty in
      let as_it_is = Seq.map (assuming placed) as_it_is in
      Seq.append as_it_is
        (Seq.append (Seq.flat_map bound (Attendance.with_latecomers seen n news)) (Seq.flat_map failed (too_few n)))
  in
  let with_new news =
    match pick.count with
    | Exactly n -> of_number n news
    | All -> Seq.flat_map attended (Attendance.of_all company news)
  in
  once world pick (Seq.flat_map with_new (Attendance.costs company))

(* {1 All together} *)

let may_interrupt options m = options.faults.interrupt && not (Machine.is_leaving m)

let interruption options program world e (c : Configuration.t) () =
  let happens =
    match c.control with
    | Ended _ -> false
    | Script m | Waiting (m, _) | Executing (m, _) -> may_interrupt options m
  in
  if not happens then Seq.Nil
  else
    match Transition.accept program world c Interruption with
    | Ok transition -> Seq.return { transition; outside = e; on = Some Interruption } ()
    | Error _ -> Seq.Nil

let may_leave options (program : Core.program) = options.faults.interrupt && program.on_interrupt <> None

let posts options program world e c : choice Seq.t =
  let post (k, x, outside) =
    let event = Transition.Input (k, x) in
    match Transition.accept program world c event with
    | Ok transition -> Some { transition; outside; on = Some event }
    | Error _ -> None
  in
  List.to_seq (List.filter_map post (inputs options program e))

let all_choices ?alike ?binding options program world e (c : Configuration.t) () =
  let unclear = ref None in
  let by_itself () =
    match c.control with
    | Waiting (_, Pick pick) -> picking ?alike ?binding ~unclear options program world e c pick ()
    | Script _ | Waiting (_, (Ask _ | Pause _ | Execute _ | Host_call _)) | Executing _ | Ended _ ->
      in_world ~unclear options program world e c ()
  in
  let from_outside () = Seq.append (posts options program world e c) (interruption options program world e c) () in
  let others () = match !unclear with Some fault -> raise (Unclear fault) | None -> Seq.Nil in
  Seq.append by_itself (Seq.append from_outside others) ()

let choices_on ?alike options program world e c = all_choices ?alike options program world e c
let without_event choices = Seq.map (fun { transition; outside; _ } -> (transition, outside)) choices
let choices ?alike options program world e c = without_event (all_choices ?alike options program world e c)

let choices_like (t : Transition.t) options program world e c =
  let binding = match t.label with Bind vs -> vs | _ -> [] in
  without_event (all_choices ~binding options program world e c)

let rec find p (choices : _ Seq.t) =
  match choices () with
  | Nil -> None
  | Cons (choice, _) when p choice -> Some choice
  | Cons (_, rest) -> find p rest

let is_voluntary (t : Transition.t) = match t.label with Interrupt | Input _ -> true | _ -> false

let may_stay_away options e v =
  List.mem v e.lost || (Faults.is_possible options.faults.join && options.may_be_late v)

(* Those who were late already may be so again. *)
let may_all_stay_away options e vs =
  let is_new v = not (List.mem v e.lost || List.mem v e.late) in
  List.for_all (may_stay_away options e) vs
  && match join_limit options e with
  | Never | Any_number -> true
  | At_most n -> List.length (List.filter is_new (List.sort_uniq String.compare vs)) <= n - List.length e.late

let only_recruits options e ts =
  let rec recruits found (ts : Transition.t list) =
    match ts with
    | [] -> Some found
    | t :: rest when is_voluntary t -> recruits found rest
    | { label = Recruit v; _ } :: rest -> recruits (v :: found) rest
    | _ :: _ -> None
  in
  match recruits [] ts with None -> false | Some vs -> may_all_stay_away options e vs

(* Nothing can be posted where nothing at all can happen: that is an end. *)
let is_stuck options (program : Core.program) e choices =
  let is_over = Option.is_none (find (fun _ -> true) choices) in
  let goes_on =
    if program.recruits then not (only_recruits options e (List.of_seq (Seq.map fst choices)))
    else Option.is_some (find (fun (t, _) -> not (is_voluntary t)) choices)
  in
  is_over || not (goes_on || owes options program e)
