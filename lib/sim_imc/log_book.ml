open Dolphin_imc
module Level = Message.Log_book_entry.Type

type line = { entity : int; level : Level.t; context : string; text : string }

let entity line = line.entity

let to_message ~time { level; context; text; entity = _ } =
  Message.Log_book_entry { type_ = level; htime = time; context; text }

let engine = 55
let by_engine level text = { entity = engine; level; context = "Plan.Engine"; text }
let informs format = Printf.ksprintf (by_engine Info) format
let start_requested ~plan = informs "request -- Start Plan (%s)" plan
let stop_requested ~plan = informs "request -- Stop Plan (%s)" plan
let initializing ~plan = informs "plan initializing: %s" plan
let executing ~maneuver = informs "%s: executing maneuver" maneuver

let answered ?(error = false) ~request ~plan info =
  let request = match request with `Start -> "Start" | `Stop -> "Stop" in
  by_engine (if error then Error else Info) (Printf.sprintf "reply -- %s Plan (%s) -- %s" request plan info)

let refused ~why =
  let unread = "parse error" in
  let n = String.length unread in
  let is_unread = String.length why >= n && String.sub why 0 n = unread in
  by_engine Warning (Printf.sprintf "plan %s failed: %s" (if is_unread then "parse" else "load") why)

let completed = informs "plan completed"
let stopped = informs "plan stopped"
let ready = informs "vehicle ready"
let supervisor = 75
let by_supervisor level text = { entity = supervisor; level; context = "Supervisors.Vehicle"; text }

(* The log book has a word of its own for the mode MANEUVER. *)
let mode (mode : Message.Vehicle_state.Op_mode.t) =
  let name =
    match mode with
    | Maneuver -> "MANEUVERING"
    | Service | Calibration | Error | External | Boot | Other _ -> Message.Vehicle_state.Op_mode.name mode
  in
  by_supervisor Warning (Printf.sprintf "now in '%s' mode" name)

let aborted ~why = by_supervisor Error why
let database = 54
let by_database level text = { entity = database; level; context = "Plan.DB"; text }
let storing ~plan = by_database Warning (Printf.sprintf "storing plan '%s' issued through a PlanControl request" plan)
let stored ~plan ~info = by_database Info (Printf.sprintf "set plan (%s) -- %s" plan info)
