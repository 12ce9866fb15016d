open Dolphin_semantics

type ending = Succeeds | May_fail | Fails

type options = {
  endings : Core.vehicle -> string -> ending;
  may_be_late : Core.vehicle -> bool;
  answers : string -> string list list;
  replies : string -> (Core.value, string) result list list;
  faults : Faults.t;
}

exception Unclear of Fault.t

let clear = function Ok x -> x | Error fault -> raise (Unclear fault)

let default =
  { endings = (fun _ _ -> Succeeds); may_be_late = (fun _ -> true); answers = (fun _ -> []); replies = (fun _ -> []);
    faults = Faults.none }

let ending options v name =
  match options.endings v name, options.faults.fail with
  | (Fails | May_fail | Succeeds) as ending, Never -> ending
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

(* Counted is only what has a bound, [asked] and [called] only as far as answers and replies depend on it: what makes no
   difference must not tell states apart. Vehicles, prompts and calls are in ascending order. *)
type t = {
  failed : int;
  losses : int;
  lost : Core.vehicle list;  (* and not heard of since *)
  late : Core.vehicle list;  (* those that were late, or missing, at some time *)
  asked : (string * int) list;  (* by prompt *)
  called : (string * int) list;  (* by name of the call *)
}

let initial = { failed = 0; losses = 0; lost = []; late = []; asked = []; called = [] }

let compare a b =
  let both first second = if first <> 0 then first else second () in
  if a == b then 0
  else
    let compare_times (name, n) (name', n') = both (String.compare name name') (fun () -> Int.compare n n') in
    let compare_times = List.compare compare_times in
    let compare_vehicles = List.compare String.compare in
    both (Int.compare a.failed b.failed) (fun () ->
        both (Int.compare a.losses b.losses) (fun () ->
            both (compare_vehicles a.lost b.lost) (fun () ->
                both (compare_vehicles a.late b.late) (fun () ->
                    both (compare_times a.asked b.asked) (fun () -> compare_times a.called b.called)))))

let hash e =
  let mix h x = (h * 31) + Hashtbl.hash x in
  let times h (_, n) = (h * 31) + n in
  let counted = List.fold_left times (List.fold_left times ((e.failed * 7) + e.losses) e.asked) e.called in
  List.fold_left mix (List.fold_left mix counted e.lost) e.late

let lost e = e.lost

let renamed f e =
  let all vs = List.sort String.compare (List.map f vs) in
  { e with lost = all e.lost; late = all e.late }

let add v vs = List.sort_uniq String.compare (v :: vs)
let less v vs = List.filter (fun v' -> not (String.equal v v')) vs

(* {1 Ends of tasks} *)

let failure = "failure"
let loss = "connection lost"
let endings_remember options = Faults.is_possible options.faults.loss

let task_ends options e v (p : Core.platform_task) : (Transition.event * t) list =
  let is_lost = List.mem v e.lost in
  let heard = if is_lost then { e with lost = less v e.lost } else e in
  let succeeded = (Transition.Vehicle_done v, heard) and failed e = (Transition.Vehicle_failed (v, failure), e) in
  let ends =
    match ending options v p.name, options.faults.fail with
    | Succeeds, _ -> [ succeeded ]
    | Fails, _ -> [ failed heard ]
    | May_fail, (Never | Any_number) -> [ succeeded; failed heard ]
    | May_fail, At_most most when e.failed < most -> [ succeeded; failed { heard with failed = e.failed + 1 } ]
    | May_fail, At_most _ -> [ succeeded ]
  in
  let lost e = [ (Transition.Vehicle_failed (v, loss), { e with lost = add v e.lost }) ] in
  match options.faults.loss with
  | _ when is_lost -> ends @ lost e
  | Any_number -> ends @ lost e
  | At_most most when e.losses < most -> ends @ lost { e with losses = e.losses + 1 }
  | At_most _ | Never -> ends

(* {1 Answers and replies} *)

let times name counted = Option.value (List.assoc_opt name counted) ~default:0

(* What may come this time, of [rounds] of which the last is for all later times. *)
let this_time name counted rounds =
  match List.length rounds with 0 -> [] | n -> List.nth rounds (min (times name counted) (n - 1))

(* [counted] after one more time, as far as [rounds] tell times apart. *)
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
   first. Who has nothing else to say has said nothing. *)
let after_refusal options program ~before e (c : Configuration.t) why =
  match c.control with
  | Waiting (_, Ask prompt) when times prompt before.asked < List.length (options.answers prompt) - 1 ->
    answered options program e prompt
  | Waiting _ | Script _ | Executing _ | Ended _ -> [ (Ok (Transition.Nobody_answers why), e) ]

(* {1 Transitions} *)

let events options program e (c : Configuration.t) (awaited : Transition.awaited) =
  match awaited, c.control with
  | End_of v, _ -> (
      match Vehicle_map.find_opt v c.shared.allocation with
      | Some p -> List.map (fun (event, e) -> (Ok event, e)) (task_ends options e v p)
      | None -> [])
  | Answer, Waiting (_, Ask prompt) -> answered options program e prompt
  | Reply, Waiting (_, Host_call { subject; member; _ }) ->
    replied options e (Configuration.site c) (Machine.name_of_call ~subject ~member)
  | Expiry_of timer, _ -> [ (Ok (Transition.Timer_expired timer), e) ]
  | (Answer | Reply), (Script _ | Waiting _ | Executing _ | Ended _) -> []

let in_world options program world e c =
  let internal = List.of_seq (Seq.map (fun t -> (t, e)) (clear (Transition.internal_all program world c))) in
  let rec accept before (event, e) =
    let of_result : _ -> (Transition.t * t) list = function
      | Ok t -> [ (t, e) ]
      | Error Transition.Not_awaited -> []
      | Error (Bad_answer why) -> List.concat_map (accept e) (after_refusal options program ~before e c why)
    in
    match event with
    | Ok event -> List.concat_map of_result (clear (Transition.accept_all program world c event))
    | Error refusal -> of_result (Error refusal)
  in
  let on_event event = List.concat_map (accept e) (events options program e c event) in
  internal @ List.concat_map on_event (Transition.awaited c)

(* {1 Who is there} *)

(* The sets of at most [most] elements of [xs], smaller ones first. *)
let subsets most xs =
  let rec of_size n xs =
    match xs with
    | _ when n = 0 -> [ [] ]
    | [] -> []
    | x :: rest -> List.map (fun set -> x :: set) (of_size (n - 1) rest) @ of_size n rest
  in
  List.concat_map (fun n -> of_size n xs) (List.init (min most (List.length xs) + 1) Fun.id)

(* The lists of at most [most] different elements of [xs]. *)
let rec arrangements most xs =
  if most = 0 then [ [] ]
  else
    let first x = List.map (fun rest -> x :: rest) (arrangements (most - 1) (List.filter (fun y -> y <> x) xs)) in
    [] :: List.concat_map first xs

(* The vehicles that [pick] may look for, and of which it is open whether they are there. *)
let uncertain options world e (c : Configuration.t) (pick : Settings.pick) =
  let may_miss v = List.mem v e.lost || (Faults.is_possible options.faults.join && options.may_be_late v) in
  let is_wanted (s : World.vehicle_state) =
    Settings.accepts { pick.filter with region = None } s && (not (List.mem s.id c.shared.bound)) && may_miss s.id
  in
  List.map (fun (s : World.vehicle_state) -> s.id) (List.filter is_wanted (World.vehicles world))

(* Who comes after all others, in this order, and who does not come. *)
type attendance = { coming : Core.vehicle list; missing : Core.vehicle list }

(* How many vehicles that are neither [lost] nor were late before this takes. *)
let cost e ~lost a =
  let is_new v = not (List.mem v lost || List.mem v e.late) in
  List.length (List.filter is_new (a.coming @ a.missing))

(* Whatever can come of a pick comes of one of these, cheaper ones first. If a number is wanted, nobody need be missing
   for it to be met, and if it is not met all may be that can be. *)
let attendances options e (pick : Settings.pick) ~lost ~late =
  let most_new =
    match options.faults.join with Never -> 0 | At_most n -> max 0 (n - List.length e.late) | Any_number -> max_int
  in
  let known = List.length (List.filter (fun v -> List.mem v e.late) late) in
  let most = if most_new > List.length late then List.length late else most_new + known in
  let ways =
    match pick.count, options.faults.join with
    | _, _ when lost = [] && late = [] -> [ { coming = []; missing = [] } ]
    | Exactly n, limit ->
      let on_the_way = List.map (fun coming -> { coming; missing = [] }) (arrangements (min n most) late) in
      let missing = match limit with Any_number -> [ late ] | Never | At_most _ -> subsets most late in
      on_the_way @ List.map (fun missing -> { coming = []; missing = lost @ missing }) missing
    | All, _ ->
      let with_missing missing =
        let others = List.filter (fun v -> not (List.mem v missing)) late in
        List.map (fun coming -> { coming; missing }) (arrangements most others)
      in
      List.concat_map
        (fun silent -> List.concat_map (fun missing -> with_missing (silent @ missing)) (subsets most late))
        (subsets (List.length lost) lost)
  in
  let by_cost a b = Int.compare (cost e ~lost a) (cost e ~lost b) in
  List.stable_sort by_cost (List.filter (fun a -> cost e ~lost a <= most_new) ways)

let picking options program world e (c : Configuration.t) (pick : Settings.pick) =
  let lost, late = List.partition (fun v -> List.mem v e.lost) (uncertain options world e c pick) in
  let remember a ((t : Transition.t), e) =
    let is_picked v = List.mem v t.next.shared.bound && not (List.mem v c.shared.bound) in
    let lost = List.filter (fun v -> not (is_picked v)) e.lost in
    let noted = List.filter (fun v -> List.mem v late) (a.coming @ a.missing) in
    let noted = match options.faults.join with At_most _ -> noted | Never | Any_number -> [] in
    (t, { e with lost; late = List.fold_left (fun vs v -> add v vs) e.late noted })
  in
  let given a =
    let assumed = List.map (fun v -> World.Late v) a.coming @ List.map (fun v -> World.Missing v) a.missing in
    let with_assumed ((t : Transition.t), e) = remember a ({ t with assumed = assumed @ t.assumed }, e) in
    List.map with_assumed (in_world options program (World.suppose assumed world) e c)
  in
  let found = Hashtbl.create 16 in
  let is_new ((t : Transition.t), _) =
    let same (t' : Transition.t) = Label.equal t.label t'.label && Configuration.equal t.next t'.next in
    let hash = Configuration.hash t.next in
    let is_new = not (List.exists same (Hashtbl.find_all found hash)) in
    if is_new then Hashtbl.add found hash t;
    is_new
  in
  List.filter is_new (List.concat_map given (attendances options e pick ~lost ~late))

(* {1 All together} *)

let interruption options program world e c =
  if not options.faults.interrupt then []
  else match Transition.accept program world c Interruption with Ok t -> [ (t, e) ] | Error _ -> []

let choices options program world e (c : Configuration.t) =
  let by_itself =
    match c.control with
    | Waiting (_, Pick pick) -> picking options program world e c pick
    | Script _ | Waiting (_, (Ask _ | Pause _ | Execute _ | Host_call _)) | Executing _ | Ended _ ->
      in_world options program world e c
  in
  by_itself @ interruption options program world e c

let goes_on choices = List.exists (fun ((t : Transition.t), _) -> not (Label.equal t.label Interrupt)) choices
