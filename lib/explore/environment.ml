open Dolphin_semantics

type endings = Succeeds | May_fail | Fails

type options = {
  endings : Core.vehicle -> string -> endings;
  failures : int option;
  answers : string -> string list list;
}

let default = { endings = (fun _ _ -> Succeeds); failures = None; answers = (fun _ -> []) }

let failing ?failures options =
  let endings v name =
    match options.endings v name with Succeeds | May_fail -> May_fail | Fails -> Fails
  in
  { options with endings; failures }

(* [failed] is counted only where there is a bound, [asked] only as far as answers depend on it: what makes no
   difference must not tell states apart. *)
type t = { failed : int; asked : (string * int) list }

let initial = { failed = 0; asked = [] }

let compare a b =
  let both first second = if first <> 0 then first else second () in
  if a == b then 0
  else
    let compare_asked (prompt, n) (prompt', n') =
      both (String.compare prompt prompt') (fun () -> Int.compare n n')
    in
    both (Int.compare a.failed b.failed) (fun () -> List.compare compare_asked a.asked b.asked)

let hash e = List.fold_left (fun h (_, n) -> (h * 31) + n) e.failed e.asked

let failure = "failure"

let task_ends options e v (p : Core.platform_task) : (Transition.event * t) list =
  let succeeded = (Transition.Vehicle_done v, e) and failed e = (Transition.Vehicle_failed (v, failure), e) in
  match options.endings v p.name, options.failures with
  | Succeeds, _ -> [ succeeded ]
  | Fails, _ -> [ failed e ]
  | May_fail, None -> [ succeeded; failed e ]
  | May_fail, Some most when e.failed < most -> [ succeeded; failed { e with failed = e.failed + 1 } ]
  | May_fail, Some _ -> [ succeeded ]

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

let choices options program world e c =
  let internal = List.of_seq (Seq.map (fun t -> (t, e)) (Transition.internal program world c)) in
  let rec accept (event, e) =
    match Transition.accept program world c event with
    | Ok t -> Some (t, e)
    | Error Not_awaited -> None
    | Error (Bad_answer why) -> accept (Transition.Nobody_answers why, e)
  in
  let on_event event = List.filter_map accept (events options e c event) in
  internal @ List.concat_map on_event (Transition.awaited c)
