open Dolphin_imc
module Control_state = Message.Plan_control_state

type t = { sent : float; state : Control_state.t }

let names (plan : string) r = r.state.plan_id = plan

let is_busy r =
  match r.state.state with
  | Executing | Initializing -> true
  | Blocked | Ready | Other _ -> false

let succeeded r =
  match r.state.last_outcome with
  | Success -> true
  | None | Failure | Other _ -> false

let failed r =
  match r.state.last_outcome with
  | Failure -> true
  | None | Success | Other _ -> false
