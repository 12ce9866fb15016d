open Dolphin_semantics
module Canonical = Dolphin_json.Canonical
module Field = Dolphin_json.Field

let ( let* ) = Result.bind

(* {1 Writing} *)

let header ~version ~answers (program : Program_file.t) (fleet : Fleet_file.t) =
  Canonical.to_string
    (`Assoc
       (("dolphin", `String "runs") :: Provenance.members ~version program fleet
        @ [ ("answers", Field.texts answers) ]))

(* The place is for people; the number of the site is read. *)
let place p site : Field.members =
  Option.fold (Program_file.at p site) ~none:[] ~some:(fun at -> [ ("at", `String at) ]) @ [ ("site", `Int site) ]

let of_cause : Fault.cause -> Field.members = function
  | Code -> []
  | Assertion -> [ ("cause", `String "assertion") ]
  | Unknown -> [ ("cause", `String "unknown") ]
  | Task { vehicle; task } -> [ ("cause", `String "task"); ("vehicle", `String vehicle); ("task", `String task) ]

let of_ending p : Sampled_run.ending -> Field.members = function
  | Completed -> [ ("end", `String "completed") ]
  | Halted message -> [ ("end", `String "halted"); ("message", `String message) ]
  | Failed { message; site; cause } ->
    (("end", `String "failed") :: ("message", `String message) :: of_cause cause) @ place p site
  | Stuck site -> ("end", `String "stuck") :: Option.fold site ~none:[] ~some:(place p)

let of_task p ((task : Sampled_run.task), (n : Sampled_run.counts)) : Yojson.Safe.t =
  `Assoc
    ([ ("task", `String task.name); ("vehicle", `String task.vehicle) ]
     @ place p task.site
     @ [ ("began", `Int n.began); ("ended", `Int n.ended); ("failed", `Int n.failed); ("stopped", `Int n.stopped) ])

let of_handler p (site, n) : Yojson.Safe.t = `Assoc (place p site @ [ ("ran", `Int n) ])

let of_sample p ~seed (s : Sampled_run.t) =
  let list name write xs = Field.unless_empty name (fun xs -> `List (List.map (write p) xs)) xs in
  Canonical.to_string
    (`Assoc
       ((("seed", `Int seed) :: of_ending p s.ending)
        @ (("seconds", Canonical.number s.seconds) :: list "tasks" of_task s.tasks)
        @ list "handlers" of_handler s.handlers))

(* {1 Reading} *)

let to_cause members =
  let* cause = Field.optional Field.text ~default:"code" "cause" members in
  match cause with
  | "code" -> Ok Fault.Code
  | "assertion" -> Ok Fault.Assertion
  | "unknown" -> Ok Fault.Unknown
  | "task" ->
    let* vehicle = Field.get Field.text "vehicle" members in
    let* task = Field.get Field.text "task" members in
    Ok (Fault.Task { vehicle; task })
  | cause -> Error (Printf.sprintf "'%s' is not a cause of a failure" cause)

let to_ending members =
  let* kind = Field.get Field.text "end" members in
  match kind with
  | "completed" -> Ok Sampled_run.Completed
  | "halted" -> Result.map (fun message -> Sampled_run.Halted message) (Field.get Field.text "message" members)
  | "failed" ->
    let* message = Field.get Field.text "message" members in
    let* site = Field.get Field.whole "site" members in
    let* cause = to_cause members in
    Ok (Sampled_run.Failed { message; site; cause })
  | "stuck" ->
    let some json = Result.map Option.some (Field.whole json) in
    Result.map (fun site -> Sampled_run.Stuck site) (Field.optional some ~default:None "site" members)
  | kind -> Error (Printf.sprintf "'%s' is not an ending of a run" kind)

let to_task json =
  let* members = Field.members json in
  let* name = Field.get Field.text "task" members in
  let* vehicle = Field.get Field.text "vehicle" members in
  let* site = Field.get Field.whole "site" members in
  let* began = Field.get Field.whole "began" members in
  let* ended = Field.get Field.whole "ended" members in
  let* failed = Field.get Field.whole "failed" members in
  let* stopped = Field.get Field.whole "stopped" members in
  Ok ({ Sampled_run.name; vehicle; site }, { Sampled_run.began; ended; failed; stopped })

let to_handler json =
  let* members = Field.members json in
  let* site = Field.get Field.whole "site" members in
  let* ran = Field.get Field.whole "ran" members in
  Ok (site, ran)

let to_sample members =
  let* seed = Field.get Field.whole "seed" members in
  let* seconds = Field.get Field.number "seconds" members in
  let* ending = to_ending members in
  let* tasks = Field.optional (Field.list to_task) ~default:[] "tasks" members in
  let* handlers = Field.optional (Field.list to_handler) ~default:[] "handlers" members in
  Ok (seed, { Sampled_run.seconds; ending; tasks; handlers })

type before = Nothing | Header | Run of int  (* the last line there, the header once left aside *)

let follows before seed =
  match before with
  | Nothing -> Error "before the first run there is to be the header: all that --each has printed"
  | Header -> Ok ()
  | Run last when seed = last + 1 -> Ok ()
  | Run last -> Error (Printf.sprintf "the run with the seed %d is to follow that with %d" (last + 1) last)

let read_line ~header ~before ~add line =
  let* json = Result.map_error (fun _ -> "this is not JSON") (Dolphin_json.Host_value.parse line) in
  let* members = Field.members json in
  if not (List.mem_assoc "dolphin" members) then
    let* seed, sample = to_sample members in
    let* () = follows before seed in
    add ~seed sample;
    Ok (Run seed)
  else if line = header then Ok (if before = Nothing then Header else before)
  else
    Error "these are runs of another program, fleet or version of Dolphin, or with other parameters or answers"

let read_all ~header ~add name input =
  let rec go n before =
    let bad why = Error (Error.Bad_input (Printf.sprintf "%s:%d: %s" name n why)) in
    match input_line input with
    | exception End_of_file -> if before = Header || before = Nothing then bad "it has no runs" else Ok ()
    | line -> (match read_line ~header ~before ~add line with Ok before -> go (n + 1) before | Error why -> bad why)
  in
  go 1 Nothing

let read ~header path ~add =
  if path = "-" then read_all ~header ~add "standard input" stdin
  else Text_file.with_channel path (read_all ~header ~add path)
