let by_stop v : Platform.event -> bool = function
  | Task_done v' | Task_failed (v', _) -> v' = v
  | Vehicle _ | Timer _ | Input _ | Quiet -> false

let by_cancel timer : Platform.event -> bool = function
  | Timer timer' -> timer' = timer
  | Vehicle _ | Task_done _ | Task_failed _ | Input _ | Quiet -> false

let unless overtaken told =
  match Lwt.state told with Lwt.Return e -> not (overtaken e) | Fail _ | Sleep -> true

let left overtaken upcoming = Option.bind upcoming (fun told -> if unless overtaken told then Some told else None)
