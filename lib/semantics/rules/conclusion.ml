type t = {
  rules : Rule.t list;
  label : Label.t;
  next : Configuration.t;
  effects : Effect.t list;
  assumed : World.assumption list;
}

let make ?(effects = []) rule label control shared =
  { rules = [ rule ]; label; next = { control; shared }; effects; assumed = [] }

let timers_started = List.map (fun (timer, seconds) -> Effect.Set_timer (timer, seconds))

let ended (s : Shared.t) ending : Configuration.t =
  { control = Ended ending; shared = { s with allocation = Vehicle_map.empty; bound = [] } }

let ending ?(timers = []) ?(before = []) rules label (s : Shared.t) ending =
  let cancelled = List.map (fun timer -> Effect.Cancel_timer timer) timers in
  let cancelled = List.filter (fun cancel -> not (List.mem cancel before)) cancelled in
  let stopped = List.map (fun (v, _) -> Effect.Stop v) (Vehicle_map.bindings s.allocation) in
  let released = if s.bound = [] then [] else [ Effect.Release s.bound ] in
  let effects = before @ cancelled @ stopped @ released @ [ Effect.End ending ] in
  { rules; label; next = ended s ending; effects; assumed = [] }
