open Dolphin_results
open Dolphin_semantics
open Dolphin_json.Field

type cause = Choice of int | Event of Event.t
type step = { cause : cause; assumed : World.assumption list; label : string }

type t = {
  program : Header.source;
  fleet : Header.source option;
  property : string;
  steps : step list;
  cycle : step list;
}

let format = "dolphin-course"
let version = 1
let text_of_label label = Format.asprintf "%a" Label.pp label

(* {1 From transitions} *)

let is_executing (c : Configuration.t) =
  match c.control with Executing _ -> true | Script _ | Waiting _ | Ended _ -> false

(* Answers to the questions that stand. *)
let confirmations (c : Configuration.t) (t : Transition.t) : Transition.event list =
  let reply =
    match t.label with
    | Answer text -> Option.to_result ~none:"" (Answer.confirmation text)
    | _ -> Error "the fleet's answers are neither yes nor no"
  in
  let to_question : Transition.awaited -> Transition.event option = function
    | Answer_to (question, _) -> Some (Confirmed (question, reply))
    | End_of _ | Expiry_of _ | Recruit_for _ | Answer | Reply -> None
  in
  List.filter_map to_question (Transition.awaited c)

(* Events that the transition may be an answer to: the awaited ones, and those in its label. *)
let candidates program (c : Configuration.t) (t : Transition.t) : Transition.event list =
  let of_awaited : Transition.awaited -> Transition.event option = function
    | End_of v -> Some (Vehicle_done v)
    | Expiry_of timer -> Some (Timer_expired timer)
    | Answer_to _ | Recruit_for _ | Answer | Reply -> None
  in
  match t.label with
  | Fail (v, _, why) -> [ Vehicle_failed (v, why) ]
  | (Answer _ | No_answer) when is_executing c -> confirmations c t
  | Recruit v ->
    let of_recruit : Transition.awaited -> Transition.event option = function
      | Recruit_for (number, _) -> Some (Recruited (number, v))
      | End_of _ | Expiry_of _ | Answer_to _ | Answer | Reply -> None
    in
    List.filter_map of_recruit (Transition.awaited c)
  | Answer text -> Option.to_list (Result.to_option (Answer.event program text))
  | No_answer -> [ Nobody_answers "none is given" ]
  | Reply _ -> (match t.next.control with Script { focus = Give x; _ } -> [ Replied x ] | _ -> [])
  | No_reply why -> [ Host_failed why ]
  | Input (k, x) -> [ Input (k, x) ]
  | Interrupt -> [ Interruption ]
  | _ -> List.filter_map of_awaited (Transition.awaited c)

let step program world c (t : Transition.t) =
  let world = World.suppose t.assumed world in
  let is_it (t' : Transition.t) = Label.equal t.label t'.label && Configuration.equal t.next t'.next in
  let rec choice i (ts : Transition.t Seq.t) =
    match ts () with
    | Seq.Nil -> None
    | Seq.Cons (t', _) when is_it t' -> Some (Choice i)
    | Seq.Cons (_, rest) -> choice (i + 1) rest
  in
  let event e =
    match Transition.accept_all program world c e with Ok (Ok t' :: _) -> is_it t' | Ok _ | Error _ -> false
  in
  let cause =
    match choice 0 (fst (Transition.internal_listed program world c)) with
    | Some cause -> cause
    | None -> (
        match t.label, List.find_opt event (candidates program c t) with
        | _, Some e -> Event (Event.of_event e)
        | No_answer, None ->
          (* The question stayed unanswered for another reason: an answer that was refused. *)
          let why = match t.next.control with Ended (Failed fault) -> fault.message | _ -> "" in
          let prompt =
            match c.control with Waiting (_, Ask prompt) -> Printf.sprintf "no answer to '%s': " prompt | _ -> ""
          in
          let n = String.length prompt in
          let why = if String.length why > n then String.sub why n (String.length why - n) else why in
          Event (No_answer why)
        | _, None -> invalid_arg ("Witness.step: no transition " ^ text_of_label t.label))
  in
  { cause; assumed = t.assumed; label = text_of_label t.label }

let rec steps program world c = function
  | [] -> []
  | (t : Transition.t) :: rest ->
    let s = step program world c t in
    s :: steps program world t.next rest

(* {1 To transitions} *)

type misfit = { number : int; why : string }

(* The reason why the step is missing: it does not fit, or sensors leave it open. *)
type obstacle = Unfit of string | Unsettled of string

let chosen program world c i =
  let rec nth i (ts : Transition.t Seq.t) =
    match ts () with
    | Seq.Nil -> None
    | Seq.Cons (t, rest) -> if i = 0 then Some t else nth (i - 1) rest
  in
  let listed, unclear = Transition.internal_listed program world c in
  match nth i listed, unclear with
  | Some t, _ -> Ok t
  | None, Some fault -> Error (Unsettled fault.message)
  | None, None -> Error (Unfit "the program has no such choice there")

let caused program world c e =
  let refused : Transition.refusal -> _ = function
    | Not_awaited -> Error (Unfit (Format.asprintf "the program does not wait for %a there" Event.pp e))
    | Bad_answer why -> Error (Unfit why)
  in
  match Event.to_event program c e with
  | Error (No_value why) -> Error (Unfit why)
  | Error (Refused why) -> refused why
  | Ok event -> (
      match Transition.accept_all program world c event with
      | Ok (Ok t :: _) -> Ok t
      | Ok (Error why :: _) -> refused why
      | Ok [] -> refused Not_awaited
      | Error fault -> Error (Unsettled fault.message))

let take program world (c : Configuration.t) s =
  let world = World.suppose s.assumed world in
  let found = match s.cause with Choice i -> chosen program world c i | Event e -> caused program world c e in
  match found with
  | Ok t when text_of_label t.label = s.label -> Ok { t with assumed = s.assumed }
  | Ok t -> Error (Printf.sprintf "the program does %s there, and not %s" (text_of_label t.label) s.label)
  | Error (Unfit why) -> Error (Printf.sprintf "%s (%s)" why s.label)
  | Error (Unsettled why) -> Error why

let follow program world witness =
  let rec go number (c : Configuration.t) taken = function
    | [] -> Ok (List.rev taken)
    | s :: rest -> (
        match take program world c s with
        | Ok t -> go (number + 1) t.next (t :: taken) rest
        | Error why -> Error (List.rev taken, { number; why }))
  in
  let start = Configuration.initial program and first = List.length witness.steps in
  let split ts = (List.filteri (fun i _ -> i < first) ts, List.filteri (fun i _ -> i >= first) ts) in
  Result.map split (go 1 start [] (witness.steps @ witness.cycle))

(* {1 Lines} *)

let of_sensed (x : Core.value) : Yojson.Safe.t =
  match x with
  | Boolean b -> `Bool b
  | x -> ( match Value.to_number x with Some n -> `Float n | None -> invalid_arg "Witness.of_sensed: no number")

let json_of_assumption (a : World.assumption) : Yojson.Safe.t =
  match a with
  | Late v -> `Assoc [ ("late", `String v) ]
  | Missing v -> `Assoc [ ("missing", `String v) ]
  | Sensed (sensor, v, x) ->
    let vehicle : members =
      match sensor with
      | Battery -> [ ("battery", `String v) ]
      | Speed -> [ ("speed", `String v) ]
      | Connected -> [ ("connected", `String v) ]
      | Progress -> [ ("progress", `String v) ]
      | Measurement name -> [ ("reading", `String name); ("vehicle", `String v) ]
    in
    `Assoc (vehicle @ [ ("is", of_sensed x) ])
  | Placed (v, { latitude; longitude; height }) ->
    `Assoc [ ("position", `String v); ("is", `List [ `Float latitude; `Float longitude; `Float height ]) ]
  | Claim (text, holds) -> `Assoc [ ("claim", `String text); ("is", `Bool holds) ]

let sensed (sensor : Core.sensor) v found =
  let value =
    if sensor = Connected then Result.map (fun b -> Core.Boolean b) (get truth "is" found)
    else Result.map (fun x -> Core.Number x) (get number "is" found)
  in
  Result.map (fun x -> World.Sensed (sensor, v, x)) value

let assumption_of_json json : (World.assumption, string) result =
  let* found = members json in
  match found with
  | (("late" | "missing") as kind, name) :: _ ->
    let* v = text name in
    Ok (if kind = "late" then World.Late v else Missing v)
  | (("battery" | "speed" | "connected" | "progress") as sensor, name) :: _ ->
    let* v = text name in
    let sensor : Core.sensor =
      match sensor with
      | "battery" -> Battery
      | "speed" -> Speed
      | "progress" -> Progress
      | _ -> Connected
    in
    sensed sensor v found
  | ("reading", name) :: _ ->
    let* name = text name in
    let* v = get text "vehicle" found in
    sensed (Measurement name) v found
  | ("position", name) :: _ -> (
      let* v = text name in
      let* coordinates = get (list number) "is" found in
      match coordinates with
      | [ latitude; longitude; height ] -> (
          match Dolphin_geo.Position.make ~latitude ~longitude ~height with
          | Ok p -> Ok (World.Placed (v, p))
          | Error fault -> Error (Format.asprintf "%a" Dolphin_geo.Position.pp_error fault))
      | _ -> Error "a position is three numbers")
  | ("claim", claimed) :: _ ->
    let* claimed = text claimed in
    let* holds = get truth "is" found in
    Ok (World.Claim (claimed, holds))
  | _ -> Error "unknown assumption: expected late, missing, battery, speed, connected, progress, reading, position or \
                claim"

let json_of_step s : Yojson.Safe.t =
  let cause = match s.cause with Choice i -> [ ("choice", `Int i) ] | Event h -> Event.members h in
  let assumed = unless_empty "assumed" (fun all -> `List (List.map json_of_assumption all)) s.assumed in
  `Assoc ((("label", `String s.label) :: cause) @ assumed)

let step_of_json json =
  let* found = members json in
  let* label = get text "label" found in
  let* items = optional (list any) ~default:[] "assumed" found in
  let* assumed = Results.map assumption_of_json items in
  if List.mem_assoc "choice" found then
    let* i = get whole "choice" found in
    if i < 0 then Error "a choice is a number from 0" else Ok { cause = Choice i; assumed; label }
  else
    let* h = Event.of_members found in
    Ok { cause = Event h; assumed; label }

let to_lines witness =
  let header : Yojson.Safe.t =
    `Assoc
      [ ("format", `String format);
        ("version", `Int version);
        ("program", Dolphin_json.Codec.write Header.source_codec witness.program);
        ("fleet", of_option (Dolphin_json.Codec.write Header.source_codec) witness.fleet);
        ("property", `String witness.property);
        ("steps", `Int (List.length witness.steps));
        ("cycle", `Int (List.length witness.cycle)) ]
  in
  List.map Dolphin_json.Canonical.to_string (header :: List.map json_of_step (witness.steps @ witness.cycle))

let of_header json =
  match json with
  | `Assoc found when List.assoc_opt "format" found = Some (`String format) ->
    let* its_version = get whole "version" found in
    if its_version <> version then
      Error (Printf.sprintf "this run is of version %d; version %d is known here" its_version version)
    else
      let* program = get (Dolphin_json.Codec.read Header.source_codec) "program" found in
      let* fleet = get (nullable (Dolphin_json.Codec.read Header.source_codec)) "fleet" found in
      let* property = get text "property" found in
      let* n = get whole "steps" found in
      let* m = get whole "cycle" found in
      Ok ({ program; fleet; property; steps = []; cycle = [] }, n, m)
  | _ -> Error "this is not a run to follow: its first line is not the header of one"

let parsed number line =
  Result.map_error (fun _ -> Printf.sprintf "line %d is not JSON" number) (Dolphin_json.Host_value.parse line)

let of_lines lines =
  match lines with
  | [] -> Error "this is not a run to follow: it is empty"
  | first :: rest ->
    let* json = parsed 1 first in
    let* witness, n, m = of_header json in
    let step (number, line) =
      let* json = parsed number line in
      Result.map_error (Printf.sprintf "line %d: %s" number) (step_of_json json)
    in
    let* all = Results.map step (List.mapi (fun i line -> (i + 2, line)) rest) in
    if n < 0 || m < 0 || List.length all <> n + m then
      Error (Printf.sprintf "%d steps are announced, and %d are there" (n + m) (List.length all))
    else Ok { witness with steps = List.filteri (fun i _ -> i < n) all; cycle = List.filteri (fun i _ -> i >= n) all }
