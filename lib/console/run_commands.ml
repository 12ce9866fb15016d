open Dolphin_app
open Dolphin_json
open Field
open Lwt.Infix
open Exchange
module Request = Dolphin_http.Request
module Response = Dolphin_http.Response

let not_busy h =
  if Session.busy h then refuse 409 "busy" "a run goes on: one at a time" else Ok ()

let unavailable e = refusal 503 "unavailable" (String.concat "; " (Error.sentences e))

let started run : json = `Assoc [ ("run", `String (Live_run.id run)) ]

let speed found =
  let* speed = optional number "speed" found in
  match speed with
  | Some x when not (x > 0. && x <= 100_000.) -> bad "the speed is a number above 0, or null: as fast as it goes"
  | speed -> Ok speed

(* {1 Beginning} *)

let of_refused result = Result.map_error of_refusal result

(* The reply of a worker to a request. *)
let prepared h role ~client task ?(query = []) body =
  let order = { Worker.task; workspace = Session.workspace h; query } in
  Worker_pool.whole (Session.workers h role) ~client order ~body () >|= function
  | Error r -> Error (of_refusal r)
  | Ok { Response.status = 200; body = Text text; _ } ->
    of_refused (Result.bind (needed (Host_value.parse text)) (fun json -> needed (members json)))
  | Ok response -> Error response

type options = { speed : float option; seed : int option; answers : string list; people : bool }

let options found =
  let* speed = speed found in
  let* seed = optional whole "seed" found in
  let* answers = optional (list Field.text) "answers" found in
  let* people = optional truth "people" found in
  Ok { speed; seed; answers = Option.value answers ~default:[]; people = people = Some true }

let begin_ h ~client found { speed; seed; answers; people } =
  let* () = not_busy h in
  let* path = get Field.text "program" found in
  let* named = optional Field.text "fleet" found in
  let* set = set found in
  let settings = (Session.settings h).run and w = Session.workspace h in
  let* program = Workspace.program w ~set path in
  let is_wanted = Run.is_simulated settings || named <> None in
  let* fleet = if is_wanted then Workspace.fleet w ~program:program.path named else Ok Fleet_file.nobody in
  let* program = Workspace.within fleet program in
  let* journal = Result.map_error unavailable (Run_folder.fresh ~program:program.path) in
  let settings = { settings with speed; seed; answers; people; socket = true } in
  let order = { Live_run.program; fleet; settings } in
  let by = Session.operator h client in
  Ok (started (Session.begin_run h (fun ~id ~changed -> Live_run.start ?by ~id ~changed ~journal order)))

(* The program is read here, too, but only once a worker has read it within its limits, and while no run goes on. *)
let start h ~client (r : Request.t) found =
  let simulated = Run.is_simulated (Session.settings h).run in
  let wanted =
    let* () = not_busy h in
    let* options = options found in
    if (not simulated) && options.speed <> None then
      bad "vehicles of a network are not simulated: their run has no speed"
    else Ok options
  in
  match wanted with
  | Error r -> Lwt.return (Error (of_refusal r))
  | Ok options ->
    let query = if simulated then [] else [ ("network", "true") ] in
    prepared h Steers ~client "start" ~query r.body >>= function
    | Error response -> Lwt.return (Error response)
    | Ok _ -> Session.listening_left h (fun () -> of_refused (begin_ h ~client found options))

let resume h ~client (r : Request.t) found =
  let go_on kept =
    let* () = not_busy h in
    let* people = optional truth "people" found in
    let* { Kept_runs.path; journal; set; speed } = Kept_runs.of_json kept in
    let* program = Workspace.program (Session.workspace h) ~set path in
    let fleet = { Fleet_file.nobody with path = None } in
    let settings = { (Session.settings h).run with speed; seed = None; people = people = Some true; socket = true } in
    let order = { Live_run.program; fleet; settings } in
    let by = Session.operator h client in
    Ok (started (Session.begin_run h (fun ~id ~changed -> Live_run.resume ?by ~id ~changed ~journal order)))
  in
  match not_busy h with
  | Error r -> Lwt.return (Error (of_refusal r))
  | Ok () ->
    prepared h Steers ~client "broken-off" r.body >>= function
    | Error response -> Lwt.return (Error response)
    | Ok kept -> Session.listening_left h (fun () -> of_refused (go_on kept))

(* {1 Counterexamples} *)

let subject_of = function
  | "exploration" -> Ok Analysis.Exploration
  | "timing" -> Ok Analysis.Timing
  | _ -> bad "of is \"exploration\" or \"timing\""

let no_counterexample = refusal 409 "no-counterexample" "no run was found that could be carried out"

(* The run that an analysis has found, carried out on the simulated fleet. *)
let enact h found =
  let* () = not_busy h in
  let* subject = Result.bind (get Field.text "of" found) subject_of in
  let* speed = speed found in
  let* analysis = Option.to_result ~none:no_counterexample (Session.analysis h subject) in
  let* text = Option.to_result ~none:no_counterexample (Analysis.shown analysis) in
  let lines = List.filter (( <> ) "") (String.split_on_char '\n' text) in
  let* witness = Result.map_error (fun _ -> no_counterexample) (Dolphin_trace.Witness.of_lines lines) in
  let* program, fleet = Analysis_work.witnessed (Session.workspace h) (Analysis.order analysis) witness in
  Ok (started (Session.begin_run h (fun ~id ~changed -> Live_run.enact ~id ~changed ~speed program fleet witness)))

(* {1 While it goes on} *)

let going_on h =
  match Session.run h with
  | Some run when Live_run.goes_on run -> Ok run
  | Some _ | None -> refuse 409 "no-run" "no run goes on"

(* The log names the client. Of operators with names, journal and log have the act already. *)
let without_helm h run client what =
  if Session.operator h client = None && Helm.holder (Session.helm h) <> Some client then
    Live_run.remark run (Printf.sprintf "%s %s, without the helm" client what)

(* Without [all], each Stop goes one step further: two people who press it at once would end what the first one has
   begun, the vehicles' way home perhaps. *)
let stop h client found =
  let* all = optional truth "all" found in
  let* run = going_on h in
  let stopping : Live_run.stopping = match all with None -> Next | Some false -> Program | Some true -> All in
  Live_run.stop ?by:(Session.operator h client) run stopping;
  without_helm h run client "stops it";
  Ok (`Assoc [])

(* {2 Another program} *)

let differences h role ~client found =
  match going_on h with
  | Error r -> Lwt.return (Error (of_refusal r))
  | Ok run ->
    let found = ("before", `String (Live_run.program run).source) :: List.remove_assoc "before" found in
    prepared h role ~client "differences" (Canonical.to_string (`Assoc found))

let of_replacement : Replacement.refusal -> refusal = fun refused ->
  let status, code =
    match refused with
    | Busy -> (409, "busy")
    | No_journal -> (409, "no-journal")
    | Wrong_program _ -> (422, "bad-program")
    | Differs _ -> (422, "differs")
    | Over -> (409, "no-run")
  in
  refusal status code (Replacement.message refused)

(* The program is read here, too, but only once a worker has read it within its limits. *)
let replace h ~client (r : Request.t) _ =
  match going_on h with
  | Error r -> Lwt.return (Error (of_refusal r))
  | Ok run ->
    prepared h Steers ~client "replace" r.body >>= function
    | Error response -> Lwt.return (Error response)
    | Ok ready -> (
        let order =
          let* path = get Field.text "path" ready in
          let* hash = get Field.text "hash" ready in
          let* set = set ready in
          Ok (path, hash, set)
        in
        match order with
        | Error r -> Lwt.return (Error (of_refusal r))
        | Ok (path, hash, set) ->
          Live_run.replace ?by:(Session.operator h client) run ~set ~hash path >|= function
          | Ok time -> Ok (`Assoc [ ("time", Canonical.number time) ])
          | Error refused -> Error (of_refusal (of_replacement refused)))

(* {2 Answers} *)

let not_yours h prompt =
  let whom = Option.value (Session.addressee h prompt) ~default:"another operator" in
  refusal 403 "addressed" ("this question is for " ^ whom)

(* The questions that a request would answer. *)
let prompts run found =
  match List.assoc_opt "question" found, List.assoc_opt "key" found with
  | Some (`Int number), _ -> Option.to_list (Live_run.prompt_of run number)
  | _, Some (`String key) -> List.filter (( = ) key) (Live_run.open_prompts run)
  | _, _ -> []

let is_addressed h client found =
  match Session.run h with
  | None -> false
  | Some run ->
    let is_for_client prompt = Session.addressee h prompt <> None && Session.may_answer h client prompt in
    List.exists is_for_client (prompts run found)

let answer h client found =
  let* run = going_on h in
  let* number = get whole "question" found in
  let* text = get Field.text "text" found in
  let not_allowed prompt = if Session.may_answer h client prompt then None else Some (not_yours h prompt) in
  let* () = Option.fold (Option.bind (Live_run.prompt_of run number) not_allowed) ~none:(Ok ()) ~some:Result.error in
  let answered = Live_run.answer ?by:(Session.operator h client) run number text in
  let* () = Result.map_error (refusal 409 "answered") answered in
  without_helm h run client "answers";
  Ok (`Assoc [])

(* A pair, or pairs as people type them. *)
let pairs found =
  match List.assoc_opt "pairs" found with
  | Some (`String text) -> needed (Typed_input.read text)
  | Some _ -> bad "pairs is a text, as in \"target: [1, 2]\""
  | None ->
    let* key = get Field.text "key" found in
    let* value = get any "value" found in
    let* value = needed (Host_value.data_of_json value) in
    Ok [ (key, value) ]

let is_for_another h client run (key, _) =
  List.mem key (Live_run.open_prompts run) && not (Session.may_answer h client key)

let post h client found =
  match Result.bind (going_on h) (fun run -> Result.map (fun pairs -> (run, pairs)) (pairs found)) with
  | Error r -> Lwt.return (Error r)
  | Ok (run, pairs) when List.exists (is_for_another h client run) pairs ->
    let prompt, _ = List.find (is_for_another h client run) pairs in
    Lwt.return (Error (not_yours h prompt))
  | Ok (run, pairs) ->
    Live_run.post ?by:(Session.operator h client) run pairs >|= function
    | Ok time ->
      without_helm h run client ("posts " ^ String.concat ", " (List.map fst pairs));
      Ok (`Assoc [ ("time", Canonical.number time) ])
    | Error why -> refuse 422 "not-posted" why
