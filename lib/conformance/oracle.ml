open Dolphin_results
open Dolphin_semantics
open Dolphin_trace
open Dolphin_json.Field
module Diagnostic = Dolphin_syntax.Diagnostic
module Location = Dolphin_syntax.Location
module Scenario = Dolphin_scenario.Scenario

type json = Yojson.Safe.t
type given = { program : Core.program; nodes : Nodes.t; world : World.t; scenario : Scenario.t }
type transitions = {
  internal : Core.program -> World.t -> Configuration.t -> Transition.t Seq.t;
  accept : Core.program -> World.t -> Configuration.t -> Transition.event -> (Transition.t, Transition.refusal) result;
}

type t = { name : string; transitions : transitions; given : given option }

let version = 1
let start_with transitions ~name = { name; transitions; given = None }
let start ~name = start_with { internal = Transition.internal; accept = Transition.accept } ~name

(* {1 Errors} *)

(** Why a request has no answer. *)
type error =
  | No_json of string
  | Bad_request of string
  | Unknown_request of string
  | No_program
  | Bad_configuration of string
  | Bad_world of string
  | Bad_event of string
  | Too_large of string
  | Bad_faults of string
  | Bad_run of string

let explain = function
  | No_json why -> ("no-json", why)
  | Bad_request why -> ("bad-request", why)
  | Unknown_request name ->
    ("unknown-request",
     Printf.sprintf "unknown request %S: the requests are hello, initial, step, times and dated" name)
  | No_program -> ("no-program", "no program was given: initial comes first")
  | Bad_configuration why -> ("bad-configuration", why)
  | Bad_world why -> ("bad-world", why)
  | Bad_event why -> ("bad-event", why)
  | Too_large why -> ("too-large", why)
  | Bad_faults why -> ("bad-faults", why)
  | Bad_run why -> ("bad-run", why)

let of_error error : members =
  let code, message = explain error in
  [ ("error", `Assoc [ ("code", `String code); ("message", `String message) ]) ]

let error make result = Result.map_error make result

(* {1 Programs} *)

(* The faults of a fleet are not part of conformance in detail. *)
let of_diagnostic ~part (d : Diagnostic.t) : json =
  let code = if part = "fleet" then part else Diagnostic.code_name d.code in
  let place =
    if d.at = Location.none then []
    else [ ("line", `Int (Location.line d.at)); ("column", `Int (Location.column d.at)) ]
  in
  `Assoc
    ([ ("in", `String part); ("code", `String code) ] @ place
     @ [ ("message", `String d.message) ]
     @ match d.hint with None -> [] | Some hint -> [ ("hint", `String hint) ])

let is_error (d : Diagnostic.t) = d.severity = Error
let rejected ~part found = Error (List.map (of_diagnostic ~part) (List.filter is_error found))

let compile source =
  match Dolphin_syntax.Parse.program ~file:"program" source with
  | Error found -> rejected ~part:"program" found
  | Ok ast -> (
      match Elaborate.program ~source_name:"program" ast with
      | Error found -> rejected ~part:"program" found
      | Ok (program, _) -> Ok program)

let inhabit source =
  match Scenario.read ~file:"fleet" source with
  | Error found -> rejected ~part:"fleet" found
  | Ok scenario -> Ok scenario

let world_of scenario = List.fold_left (fun w s -> World.add s w) World.empty (Scenario.states scenario)

let of_world world : json = `List (List.map (fun s -> `Assoc (Entry.of_state s)) (World.vehicles world))

let to_world json =
  let state json = Result.bind (members json) Entry.to_state in
  let* states = error (fun why -> Bad_world why) (list state json) in
  Ok (List.fold_left (fun w s -> World.add s w) World.empty states)

let configuration program c = error (fun why -> Too_large why) (Snapshot.to_json program c)

let initial o found =
  let bad result = error (fun why -> Bad_request why) result in
  let* source = bad (get text "program" found) in
  let* fleet = bad (get text "fleet" found) in
  match compile source, inhabit fleet with
  | Error ds, Ok _ | Ok _, Error ds -> Ok ({ o with given = None }, [ ("rejected", `List ds) ])
  | Error ds, Error ds' -> Ok ({ o with given = None }, [ ("rejected", `List (ds @ ds')) ])
  | Ok program, Ok scenario ->
    let program = { program with begins = scenario.begins } in
    let world = world_of scenario in
    let given = { program; nodes = Nodes.of_program program; world; scenario } in
    let* c = configuration program (Configuration.initial program) in
    Ok ({ o with given = Some given }, [ ("configuration", c); ("world", of_world world) ])

(* {1 Steps} *)

(* A pick may be met in too many ways to read. *)
let most_transitions = 10_000

let rec bounded n (xs : 'a Seq.t) =
  match xs () with
  | Seq.Nil -> Ok []
  | Seq.Cons _ when n = 0 -> Error (Too_large (Printf.sprintf "there are more than %d transitions" most_transitions))
  | Seq.Cons (x, rest) -> Result.map (fun xs -> x :: xs) (bounded (n - 1) rest)

let of_transition g c event (t : Transition.t) =
  let* next = configuration g.program t.next in
  let step = Step.members (Step.of_transition g.program c t) in
  let event = match event with None -> [] | Some h -> [ ("event", `Assoc (Event.members h)) ] in
  Ok (`Assoc (event @ step @ [ ("next", next) ]))

(* The awaited events, without the members that only an event of the kind has. *)
let patterns (c : Configuration.t) (awaited : Transition.awaited) : members list =
  let named name rest = ("event", `String name) :: rest in
  match awaited, c.control with
  | End_of v, _ -> List.map (fun name -> named name [ ("vehicle", `String v) ]) [ "done"; "failed" ]
  | Expiry_of timer, _ -> [ named "timer" [ ("timer", `Int timer) ] ]
  | Answer_to (question, prompt), _ ->
    let of_it = [ ("question", `Int question); ("prompt", `String prompt) ] in
    [ named "confirmation" of_it; named "no-confirmation" of_it ]
  | Recruit_for _, _ -> []  (* they are among [recruited] *)
  | Answer, Waiting (_, Ask prompt) -> [ named "answer" [ ("prompt", `String prompt) ]; named "no-answer" [] ]
  | Answer, (Waiting _ | Script _ | Executing _ | Ended _) -> []
  | Reply, _ -> [ named "reply" []; named "no-reply" [] ]

(* The time-out of a pick that can be met is not awaited. *)
let is_awaited ts g world c (awaited : Transition.awaited) =
  match awaited with
  | Expiry_of timer -> Result.is_ok (ts.accept g.program world c (Timer_expired timer))
  | End_of _ | Answer_to _ | Recruit_for _ | Answer | Reply -> true

let awaited ts g world c = List.filter (is_awaited ts g world c) (Transition.awaited c)

(* Those of vehicles that are there. *)
let recruited ts g world c =
  let is_accepted event = Result.is_ok (ts.accept g.program world c event) in
  let recruitable = List.of_seq (Transition.recruitable g.program world c) in
  List.map (fun e -> Event.of_event e) (List.filter is_accepted recruitable)

let of_awaited (g : given) c events recruits : json =
  let all = List.concat_map (patterns c) events @ List.map Event.members recruits in
  let input key = [ ("event", `String "input"); ("key", `String key) ] in
  let all = if Configuration.has_ended c then all else all @ List.map input g.program.inputs in
  let all = if Configuration.has_ended c then all else all @ [ [ ("event", `String "interruption") ] ] in
  `List (List.map (fun members -> `Assoc members) all)

(* Requests without further members. *)
let plain events : Event.t list =
  let of_awaited : Transition.awaited -> Event.t option = function
    | End_of v -> Some (Done v)
    | Expiry_of timer -> Some (Timer timer)
    | Answer_to _ | Recruit_for _ | Answer | Reply -> None
  in
  List.filter_map of_awaited events

let deliver ts g world c event =
  let refused code message =
    let message = match message with None -> [] | Some text -> [ ("message", `String text) ] in
    Ok (Either.Right (`Assoc ([ ("event", `Assoc (Event.members event)); ("code", `String code) ] @ message)))
  in
  let of_refusal : Transition.refusal -> _ = function
    | Not_awaited -> refused "not-awaited" None
    | Bad_answer why -> refused "bad-answer" (Some why)
  in
  match Event.to_event g.program c event with
  | Error (No_value why) -> Error (Bad_event why)
  | Error (Refused why) -> of_refusal why
  | Ok e -> (
      match ts.accept g.program world c e with
      | Ok t -> Result.map (fun t -> Either.Left t) (of_transition g c (Some event) t)
      | Error why -> of_refusal why)

let step_of ts g world c events =
  let* internal = bounded most_transitions (ts.internal g.program world c) in
  let* internal = Results.map (of_transition g c None) internal in
  let there = awaited ts g world c and recruits = recruited ts g world c in
  let* delivered = Results.map (deliver ts g world c) (Option.value events ~default:(plain there @ recruits)) in
  let caused, refused = List.partition_map Fun.id delivered in
  let refused = if refused = [] then [] else [ ("refused", `List refused) ] in
  Ok ([ ("transitions", `List (internal @ caused)); ("awaited", of_awaited g c there recruits) ] @ refused)

let step ts g found =
  let bad result = error (fun why -> Bad_request why) result in
  let* json = bad (get any "configuration" found) in
  let* c = error (fun why -> Bad_configuration why) (Snapshot.of_json g.nodes g.program json) in
  let* world = match List.assoc_opt "world" found with None | Some `Null -> Ok g.world | Some json -> to_world json in
  let* now = bad (optional whole ~default:0 "now" found) in
  let* () = if now < 0 then Error (Bad_request "\"now\" is a whole number of seconds from 0") else Ok () in
  let world = World.at (Exactly now) world in
  let to_event json = Result.bind (members json) Event.of_members in
  let* events =
    match List.assoc_opt "events" found with
    | None | Some `Null -> Ok None
    | Some json -> error (fun why -> Bad_event why) (Result.map Option.some (list to_event json))
  in
  (* A configuration that was tampered with may name variables and places that are not there. *)
  match step_of ts g world c events with
  | result -> result
  | exception (Invalid_argument _ | Not_found | Failure _ | Stack_overflow) ->
    Error (Bad_configuration "its parts do not belong together")

(* {1 Times} *)

let faults found =
  let bad result = error (fun why -> Bad_faults why) result in
  match List.assoc_opt "faults" found with
  | None | Some `Null -> Ok Dolphin_environment.Faults.none
  | Some _ ->
    let* spelled = bad (get text "faults" found) in
    bad (Dolphin_environment.Faults.of_string spelled)

let timed g : Timed_answers.given = { program = g.program; scenario = g.scenario }

let times g found =
  let* faults = faults found in
  let* times = error (fun why -> Too_large why) (Timed_answers.times ~faults (timed g)) in
  Ok (Timed_data.of_times times)

let dated g found =
  let* faults = faults found in
  let* json = error (fun why -> Bad_request why) (get any "run" found) in
  let* run = error (fun why -> Bad_event why) (list Timed_data.dated json) in
  let event (at, json) = Result.map (fun event -> (at, event)) (Result.bind (members json) Event.of_members) in
  let* run = error (fun why -> Bad_event why) (Results.map event run) in
  let* findings = error (fun why -> Bad_run why) (Timed_answers.dated ~faults (timed g) run) in
  Ok [ ("findings", Timed_data.of_findings findings) ]

(* {1 Requests} *)

let hello o : members =
  [ ("protocol", `String "dolphin-step"); ("version", `Int version); ("implementation", `String o.name) ]

let perform o found =
  let* name = error (fun why -> Bad_request why) (get text "request" found) in
  match name, o.given with
  | "hello", _ -> Ok (o, hello o)
  | "initial", _ -> initial o found
  | ("step" | "times" | "dated"), None -> Error No_program
  | "step", Some g -> Result.map (fun reply -> (o, reply)) (step o.transitions g found)
  | "times", Some g -> Result.map (fun reply -> (o, reply)) (times g found)
  | "dated", Some g -> Result.map (fun reply -> (o, reply)) (dated g found)
  | other, _ -> Error (Unknown_request other)

let answer o (request : json) : t * json =
  match request with
  | `Assoc found ->
    let id = match List.assoc_opt "id" found with None -> [] | Some id -> [ ("id", id) ] in
    let o, reply = match perform o found with Ok answered -> answered | Error e -> (o, of_error e) in
    (o, `Assoc (id @ reply))
  | _ -> (o, `Assoc (of_error (Bad_request "a request is an object")))

let deepest = 20_000

let answer_line o line =
  let o, reply =
    match Dolphin_json.Host_value.parse ~deepest line with
    | Error why -> (o, `Assoc (of_error (No_json why)))
    | Ok request -> answer o request
  in
  (o, Dolphin_json.Canonical.to_string reply)
