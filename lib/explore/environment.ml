open Dolphin_semantics

type endings = Succeeds | May_fail | Fails
type limit = Never | At_most of int | Any_number

type options = {
  endings : Core.vehicle -> string -> endings;
  failures : int option;
  losses : limit;
  latecomers : limit;
  may_be_late : Core.vehicle -> bool;
  answers : string -> string list list;
}

let default =
  { endings = (fun _ _ -> Succeeds); failures = None; losses = Never; latecomers = Never;
    may_be_late = (fun _ -> true); answers = (fun _ -> []) }

let failing ?failures options =
  let endings v name =
    match options.endings v name with Succeeds | May_fail -> May_fail | Fails -> Fails
  in
  { options with endings; failures }

let is_possible = function Never | At_most 0 -> false | At_most _ | Any_number -> true

let may_succeed options v name =
  match options.endings v name with Succeeds | May_fail -> true | Fails -> false

let may_fail options v name =
  is_possible options.losses
  || match options.endings v name, options.failures with
  | Succeeds, _ | May_fail, Some 0 -> false
  | Fails, _ | May_fail, (None | Some _) -> true

(* {1 What the outside remembers} *)

(* Counted is only what has a bound, [asked] only as far as answers depend on it: what makes no difference must not tell
   states apart. Vehicles are in ascending order. *)
type t = {
  failed : int;
  losses : int;
  lost : Core.vehicle list;  (* and not heard of since *)
  late : Core.vehicle list;  (* those that were late, or missing, at some time *)
  asked : (string * int) list;
}

let initial = { failed = 0; losses = 0; lost = []; late = []; asked = [] }

let compare a b =
  let both first second = if first <> 0 then first else second () in
  if a == b then 0
  else
    let compare_asked (prompt, n) (prompt', n') =
      both (String.compare prompt prompt') (fun () -> Int.compare n n')
    in
    let compare_vehicles = List.compare String.compare in
    both (Int.compare a.failed b.failed) (fun () ->
        both (Int.compare a.losses b.losses) (fun () ->
            both (compare_vehicles a.lost b.lost) (fun () ->
                both (compare_vehicles a.late b.late) (fun () -> List.compare compare_asked a.asked b.asked))))

let hash e =
  let mix h x = (h * 31) + Hashtbl.hash x in
  List.fold_left mix
    (List.fold_left mix (List.fold_left (fun h (_, n) -> (h * 31) + n) ((e.failed * 7) + e.losses) e.asked) e.lost)
    e.late

let lost e = e.lost
let add v vs = List.sort_uniq String.compare (v :: vs)
let less v vs = List.filter (fun v' -> not (String.equal v v')) vs

(* {1 Ends of tasks} *)

let failure = "failure"
let loss = "connection lost"
let endings_remember (options : options) = is_possible options.losses

let task_ends (options : options) e v (p : Core.platform_task) : (Transition.event * t) list =
  let is_lost = List.mem v e.lost in
  let heard = if is_lost then { e with lost = less v e.lost } else e in
  let succeeded = (Transition.Vehicle_done v, heard) and failed e = (Transition.Vehicle_failed (v, failure), e) in
  let ends =
    match options.endings v p.name, options.failures with
    | Succeeds, _ -> [ succeeded ]
    | Fails, _ -> [ failed heard ]
    | May_fail, None -> [ succeeded; failed heard ]
    | May_fail, Some most when e.failed < most -> [ succeeded; failed { heard with failed = e.failed + 1 } ]
    | May_fail, Some _ -> [ succeeded ]
  in
  let lost e = [ (Transition.Vehicle_failed (v, loss), { e with lost = add v e.lost }) ] in
  match options.losses with
  | _ when is_lost -> ends @ lost e
  | Any_number -> ends @ lost e
  | At_most most when e.losses < most -> ends @ lost { e with losses = e.losses + 1 }
  | At_most _ | Never -> ends

(* {1 Answers} *)

let times e prompt = Option.value (List.assoc_opt prompt e.asked) ~default:0

let asked_again options e prompt =
  let different = List.length (options.answers prompt) in
  let n = times e prompt + 1 in
  if n >= different then e
  else { e with asked = List.sort Stdlib.compare ((prompt, n) :: List.remove_assoc prompt e.asked) }

let answered options e prompt : (Transition.event * t) list =
  let answers = options.answers prompt in
  let last = List.length answers - 1 in
  let texts = if last < 0 then [] else List.nth answers (min (times e prompt) last) in
  match texts with
  | [] -> [ (Transition.Nobody_answers "none is given", e) ]
  | texts -> List.map (fun text -> (Transition.Answered text, asked_again options e prompt)) texts

(* {1 Transitions} *)

let events options e (c : Configuration.t) (event : Transition.event) : (Transition.event * t) list =
  match event, c.control with
  | Vehicle_done v, _ -> (
      match Configuration.Vehicle_map.find_opt v c.allocation with
      | Some p -> task_ends options e v p
      | None -> [])
  | Answered _, Waiting (_, Ask prompt) -> answered options e prompt
  | Replied _, _ -> [ (Host_failed "a host's procedures are not explored", e) ]
  | ( ( Answered _ | Vehicle_failed _ | Timer_expired _ | Nobody_answers _ | Host_failed _ | Interruption),
      (Script _ | Waiting _ | Executing _ | Ended _) ) -> [ (event, e) ]

let in_world options program world e c =
  let internal = List.of_seq (Seq.map (fun t -> (t, e)) (Transition.internal program world c)) in
  let rec accept (event, e) =
    let of_result = function
      | Ok t -> [ (t, e) ]
      | Error Transition.Not_awaited -> []
      | Error (Bad_answer why) -> accept (Transition.Nobody_answers why, e)
    in
    List.concat_map of_result (Transition.accept_all program world c event)
  in
  let on_event event = List.concat_map accept (events options e c event) in
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
let uncertain (options : options) world e (c : Configuration.t) (pick : Settings.pick) =
  let may_miss v = List.mem v e.lost || (is_possible options.latecomers && options.may_be_late v) in
  let is_wanted (s : World.vehicle_state) =
    Settings.accepts { pick.filter with region = None } s && (not (List.mem s.id c.bound)) && may_miss s.id
  in
  List.map (fun (s : World.vehicle_state) -> s.id) (List.filter is_wanted (World.vehicles world))

(* Those of [vehicles] that come late or never, in each possible way: none of them first, more of them later. Where there
   is no bound, all of them make up for any of them. *)
let latecomers (options : options) e vehicles =
  let known, others = List.partition (fun v -> List.mem v e.late) vehicles in
  match options.latecomers with
  | Never -> [ [] ]
  | Any_number -> if vehicles = [] then [ [] ] else [ []; vehicles ]
  | At_most most ->
    let known = subsets (List.length known) known in
    let with_known others = List.map (fun known -> known @ others) known in
    List.concat_map with_known (subsets (max 0 (most - List.length e.late)) others)

let picking (options : options) program world e (c : Configuration.t) (pick : Settings.pick) =
  let enough = match pick.count with Exactly n -> n | All -> max_int in
  let remember late ((t : Transition.t), e) =
    let lost = List.filter (fun v -> not (List.mem v t.next.bound)) e.lost in
    let noted = match options.latecomers with At_most _ -> late | Never | Any_number -> [] in
    (t, { e with lost; late = List.fold_left (fun vs v -> add v vs) e.late noted })
  in
  (* [silent] were lost and are not heard of; of [late], those [coming] come in this order, the others do not. *)
  let given silent late coming =
    let missing = silent @ List.filter (fun v -> not (List.mem v coming)) late in
    let assumed = List.map (fun v -> World.Late v) coming @ List.map (fun v -> World.Missing v) missing in
    let with_assumed ((t : Transition.t), e) = remember late ({ t with assumed = assumed @ t.assumed }, e) in
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
  let lost, others = List.partition (fun v -> List.mem v e.lost) (uncertain options world e c pick) in
  let of_late late =
    let of_silent silent = List.concat_map (given silent late) (arrangements enough late) in
    List.concat_map of_silent (subsets (List.length lost) lost)
  in
  List.filter is_new (List.concat_map of_late (latecomers options e others))

let choices options program world e (c : Configuration.t) =
  match c.control with
  | Waiting (_, Pick pick) -> picking options program world e c pick
  | Script _ | Waiting (_, (Ask _ | Pause _ | Execute _ | Host_call _)) | Executing _ | Ended _ ->
    in_world options program world e c
