type t =
  | Nothing_new
  | Initialises
  | No_sign
  | Runs
  | Succeeded
  | Ended of string
  | Replaced of string

let ended_badly = "the plan ended without success, and the vehicle gave no reason"
let refused = "the plan was refused, and the vehicle gave no reason"
let blocked = "the vehicle is blocked: it cannot run plans now"
let forgotten = "the vehicle knows of no plan any more: it was restarted"

(* READY with the plan's own name. *)
let of_ready ~former_ended ~accepted ~is_final (a : Attempt.t) r =
  (* Unless the plan that had its name there was ours, and ended after that report. *)
  let had_another =
    match a.before with
    | Some b -> b.sent > former_ended && not (Plan_report.names a.order.plan b)
    | None -> false
  in
  if not (accepted || a.initialised || had_another) then No_sign
  else if Plan_report.succeeded r then Succeeded
  else if is_final then Ended (if accepted then ended_badly else refused)
  else Nothing_new

let of_start ~now ~former_ended ~late (a : Attempt.t) (r : Plan_report.t) =
  let own = Plan_report.names a.order.plan r and accepted = Attempt.accepted_before r a in
  (* Any other event of the vehicle our request may undo as long as it is on its way. *)
  let is_final = accepted || Attempt.is_past ~now r a in
  if r.sent <= a.after then Nothing_new
  else
    match r.state.state with
    | Initializing -> Initialises
    (* Another's plan of that name, which ours has replaced. *)
    | Executing when own && a.accepted <> None && not accepted -> Nothing_new
    | Executing when own ->
      (* If no report came before the request, the plan may be another's as well. *)
      let may_be_another's = Attempt.was_busy_with a.order.plan a || (a.before = None && not a.adopted) in
      if may_be_another's && not (accepted || a.initialised) then No_sign else Runs
    | Executing ->
      let other = r.state.plan_id in
      if (not accepted) && (a.before = None || Attempt.was_busy_with other a) then No_sign
      else if is_final || late = Some other then Replaced other
      else Nothing_new
    | Ready when own -> of_ready ~former_ended ~accepted ~is_final a r
    | Ready when accepted -> Ended refused
    | Ready when a.initialised && Plan_report.failed r -> if is_final then Ended refused else Nothing_new
    | Blocked when accepted -> Ended blocked
    | Ready | Blocked -> No_sign
    | Other _ -> Nothing_new

let of_run ~since (a : Attempt.t) (r : Plan_report.t) =
  let own = Plan_report.names a.order.plan r in
  if r.sent <= since then Nothing_new
  else
    match r.state.state with
    | Executing when own -> Nothing_new
    | Ready when own -> if Plan_report.succeeded r then Succeeded else Ended ended_badly
    | Ready when r.state.plan_id = "" -> Ended forgotten
    | Executing | Ready -> Replaced r.state.plan_id
    | Blocked -> Ended blocked
    | Initializing | Other _ -> Nothing_new
