open Dialogue
module Rules = Set.Make (String)

type found = (unit, string) result * Rules.t

let taking (t : transition) rules = Rules.union (Rules.of_list t.rules) rules
let labels ts = String.concat ", " (List.map (fun (t : transition) -> t.label) ts)
let at_step i format = Printf.ksprintf (fun why -> Error (Printf.sprintf "step %d: %s" i why)) format

(* The beginning of a step of a trace: the knowledge about vehicles may change with it, and time passes. *)
let before (s : Case.seen) place =
  { place with world = Option.value s.world ~default:place.world; now = Option.value s.now ~default:place.now }

let candidates ask place (s : Case.seen) =
  let place = before s place in
  let steps = Dialogue.steps ask place (Some (Option.to_list s.event)) in
  (place, steps, if s.event = None then steps.internal else steps.caused)

let nothing (s : Case.seen) steps =
  match s.event, steps.refused with
  | None, _ -> Printf.sprintf "nothing happens by itself, so %s does not" s.label
  | Some event, code :: _ -> Printf.sprintf "the event %s is refused: %s" (Dolphin_json.Canonical.to_string event) code
  | Some event, [] -> Printf.sprintf "the event %s causes nothing" (Dolphin_json.Canonical.to_string event)

(* {1 The leftmost run} *)

let longest_walk = 10_000

let rec until ask place label rules n =
  match (Dialogue.steps ask place (Some [])).internal with
  | [] -> Error (Printf.sprintf "no %s before nothing happens by itself" label)
  | _ when n = 0 -> Error (Printf.sprintf "no %s within %d steps" label longest_walk)
  | t :: _ ->
    let rules = taking t rules and place = { place with configuration = t.next } in
    if Match.label label t.label then Ok (place, rules) else until ask place label rules (n - 1)

let trace ask place steps =
  let rec go i place rules = function
    | [] -> (
        match (Dialogue.steps ask place (Some [])).internal with
        | [] -> (Ok (), rules)
        | t :: _ -> (at_step i "the trace is over, and %s happens" t.label, rules))
    | Case.Until label :: rest -> (
        match until ask place label rules longest_walk with
        | Ok (place, rules) -> go (i + 1) place rules rest
        | Error why -> (at_step i "%s" why, rules))
    | Case.Step s :: rest -> (
        let place, steps, there = candidates ask place s in
        match there with
        | [] -> (at_step i "%s" (nothing s steps), rules)
        | t :: _ -> (
            match Match.difference s t with
            | Some why -> (at_step i "%s" why, rules)
            | None -> go (i + 1) { place with configuration = t.next } (taking t rules) rest))
  in
  go 1 place Rules.empty steps

(* {1 Some run} *)

let distinct places =
  let seen = Hashtbl.create 16 in
  let is_new place =
    let key = Dialogue.key place.configuration in
    if Hashtbl.mem seen key then false else (Hashtbl.replace seen key (); true)
  in
  List.filter is_new places

(* All the places that [s] may lead to. *)
let follow ask places (s : Case.seen) =
  let from place =
    let place, steps, there = candidates ask place s in
    let fits, others = List.partition (fun t -> Match.difference s t = None) there in
    (List.map (fun t -> ({ place with configuration = t.next }, t)) fits, (steps, others))
  in
  let found, missed = List.split (List.map from places) in
  let found = List.concat found in
  let rules = List.fold_left (fun rules (_, t) -> taking t rules) Rules.empty found in
  (distinct (List.map fst found), rules, missed)

let why_none (s : Case.seen) missed =
  let others = List.concat_map snd missed in
  let nearest = List.find_opt (fun (t : transition) -> Match.label s.label t.label) others in
  match Option.bind nearest (Match.difference s), others, missed with
  | Some why, _, _ -> Printf.sprintf "%s: %s" s.label why
  | None, [], (steps, _) :: _ -> nothing s steps
  | None, others, _ -> Printf.sprintf "%s is not possible; possible are %s" s.label (labels others)

(* Along [steps] as far as possible: the places reached, with the missing condition for more. *)
let along ask place steps =
  let rec go i places rules = function
    | [] -> (Ok places, rules)
    | Case.Until label :: rest -> (
        match places with
        | [ place ] -> (
            match until ask place label rules longest_walk with
            | Ok (place, rules) -> go (i + 1) [ place ] rules rest
            | Error why -> (at_step i "%s" why, rules))
        | _ -> (at_step i "\"until\" comes first", rules))
    | Case.Step s :: rest -> (
        let places, taken, missed = follow ask places s in
        let rules = Rules.union taken rules in
        match places with
        | [] -> (at_step i "%s" (why_none s missed), rules)
        | places -> go (i + 1) places rules rest)
  in
  go 1 [ place ] Rules.empty steps

let admits ask place steps =
  let reached, rules = along ask place steps in
  (Result.map ignore reached, rules)

let forbids ask place steps =
  match List.rev steps with
  | Case.Step last :: before -> (
      match along ask place (List.rev before) with
      | Error why, rules -> (Error ("the steps before the last one are not possible: " ^ why), rules)
      | Ok places, rules -> (
          match follow ask places last with
          | [], _, _ -> (Ok (), rules)
          | _ :: _, _, _ -> (at_step (List.length steps) "%s is possible" last.label, rules)))
  | Case.Until _ :: _ | [] -> (Error "a trace that is forbidden ends with a step", Rules.empty)

(* {1 All runs} *)

type all = { outcomes : Case.outcome list; rules : Rules.t }

let most_places = 20_000

(* A member that is a text, or nothing. *)
let text name (json : json) =
  match json with
  | `Assoc members -> (match List.assoc_opt name members with Some (`String x) -> x | Some _ | None -> "")
  | _ -> ""

let event name members : json = `Assoc (("event", `String name) :: members)

(* The events that [environment] makes of the awaited ones, less ends and expiries. *)
let events (environment : Case.environment) configuration awaited =
  let plan v = Option.value (List.assoc_opt v (Dialogue.running configuration)) ~default:"" in
  let of_awaited json =
    match text "event" json with
    | "failed" ->
      let v = text "vehicle" json in
      if List.mem (plan v) environment.fails || List.mem (plan v) environment.may_fail then
        [ event "failed" [ ("vehicle", `String v); ("why", `String "failure") ] ]
      else []
    | "answer" ->
      let texts = Option.value (List.assoc_opt (text "prompt" json) environment.answers) ~default:[] in
      List.map (fun answer -> event "answer" [ ("text", `String answer) ]) texts
    | "confirmation" ->
      let question = match json with `Assoc members -> List.assoc "question" members | _ -> `Null in
      List.map (fun yes -> event "confirmation" [ ("question", question); ("yes", `Bool yes) ]) [ true; false ]
    | "no-answer" | "no-confirmation" -> []
    | "reply" -> List.map (fun x -> event "reply" [ ("value", x) ]) environment.replies
    | "no-reply" -> if environment.replies = [] then [ event "no-reply" [ ("why", `String "no host") ] ] else []
    | "interruption" -> if environment.interruption then [ event "interruption" [] ] else []
    | _ -> []
  in
  let unanswered json =
    text "event" json = "answer" && not (List.mem_assoc (text "prompt" json) environment.answers)
  in
  let nobody = if List.exists unanswered awaited then [ event "no-answer" [ ("why", `String "nobody") ] ] else [] in
  List.concat_map of_awaited awaited @ nobody

let always_fails (environment : Case.environment) configuration (t : transition) =
  match t.event with
  | Some json when text "event" json = "done" ->
    let v = text "vehicle" json in
    List.exists (fun (v', plan) -> v = v' && List.mem plan environment.fails) (Dialogue.running configuration)
  | Some _ | None -> false

let successors ask environment place =
  let steps = Dialogue.steps ask place None in
  let caused = List.filter (fun t -> not (always_fails environment place.configuration t)) steps.caused in
  match events environment place.configuration steps.awaited with
  | [] -> steps.internal @ caused
  | events -> steps.internal @ caused @ (Dialogue.steps ask place (Some events)).caused

let outcome place successors : Case.outcome option =
  let left = Dialogue.pairs place.configuration in
  match Dialogue.ending place.configuration, successors with
  | Some (how, message), _ -> Some { how; message; left }
  | None, [] -> Some { how = "stuck"; message = None; left }
  | None, _ :: _ -> None

let all ask environment place =
  let known = Hashtbl.create 256 and queue = Queue.create () in
  let reach configuration =
    let key = Dialogue.key configuration in
    if not (Hashtbl.mem known key) then begin
      Hashtbl.replace known key ();
      Queue.add { place with configuration } queue
    end
  in
  let rec go outcomes rules =
    if Hashtbl.length known > most_places then
      Error (Printf.sprintf "there are more than %d configurations" most_places)
    else
      match Queue.take_opt queue with
      | None -> Ok { outcomes = List.sort_uniq compare outcomes; rules }
      | Some place ->
        let ts = successors ask environment place in
        List.iter (fun t -> reach t.next) ts;
        go (Option.to_list (outcome place ts) @ outcomes) (List.fold_left (fun rules t -> taking t rules) rules ts)
  in
  reach place.configuration;
  go [] Rules.empty
