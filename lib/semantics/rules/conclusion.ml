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

let cut timers (s : Shared.t) =
  List.map (fun timer -> Effect.Cancel_timer timer) timers
  @ List.map (fun (v, _) -> Effect.Stop v) (Vehicle_map.bindings s.allocation)

let ending ?(timers = []) ?(before = []) rules label (s : Shared.t) ending =
  let timers = List.filter (fun timer -> not (List.mem (Effect.Cancel_timer timer) before)) timers in
  let released = if s.bound = [] then [] else [ Effect.Release s.bound ] in
  let effects = before @ cut timers s @ released @ [ Effect.End ending ] in
  { rules; label; next = ended s ending; effects; assumed = [] }
