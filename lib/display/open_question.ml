open Dolphin_semantics

type t = { prompt : string; site : Core.site; is_of_task : bool; timers : Residual.timer list }

(* Latest first. *)
let rec of_task timers found (r : Residual.t) =
  match r with
  | Confirm { prompt; site; question = _ } -> { prompt; site; is_of_task = true; timers } :: found
  | During { timer; started = true; _ } -> of_parts (timer :: timers) found r
  | _ -> of_parts timers found r

and of_parts timers found r =
  let skip found _ = found in
  Residual.fold ~begun:(of_task timers) ~later:skip ~leaf:skip found r

let list (c : Configuration.t) =
  match c.control with
  | Waiting (m, Ask prompt) -> [ { prompt; site = Machine.site m; is_of_task = false; timers = [] } ]
  | Executing (_, r) -> List.rev (of_task [] [] r)
  | Waiting (_, (Pick _ | Pause _ | Execute _ | Host_call _)) | Script _ | Ended _ -> []
