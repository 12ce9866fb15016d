open Dolphin_imc
module Mode = Message.Vehicle_state.Op_mode

let of_mode mode ~error (report : Plan_report.t) =
  match (mode : Mode.t), report.state.state with
  | Service, _ -> None
  | Maneuver, Executing -> Some ("runs plan " ^ report.state.plan_id)
  | Error, _ when String.trim error <> "" -> Some ("is in mode ERROR: " ^ error)
  | mode, _ -> Some ("is in mode " ^ Mode.name mode)

let of_report (report : Plan_report.t) =
  match report.state.state with
  | Ready -> None
  | Executing -> Some ("runs plan " ^ report.state.plan_id)
  | Blocked -> Some "cannot run plans now"
  | Initializing | Other _ -> Some "begins a plan"

let obstacle ~mode ~error report =
  match (mode : (float * Mode.t) option), (report : Plan_report.t option) with
  | _, None -> Some "has not reported its plan state yet"
  | None, Some r -> of_report r
  | Some (sent, mode), Some r -> (
      match r.state.state with
      | (Ready | Executing) when r.sent > sent -> of_report r
      (* The mode has more detail. *)
      | Blocked when r.sent > sent && mode = Service -> of_report r
      | Ready | Executing | Blocked | Initializing | Other _ -> of_mode mode ~error r)
