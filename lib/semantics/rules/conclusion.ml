type t = {
  rules : Rule.t list;
  label : Label.t;
  next : Configuration.t;
  effects : Effect.t list;
  assumed : World.assumption list;
  otherwise : World.assumption list list;
}

let make ?(effects = []) rule label control shared =
  { rules = [ rule ]; label; next = { control; shared }; effects; assumed = []; otherwise = [] }

let begun =
  List.filter_map (function Residual.Wait (number, wait) -> Some (Effect.begins (number, wait)) | Key _ -> None)

let ended (s : Shared.t) ending : Configuration.t =
  { control = Ended ending; shared = Shared.without_fresh { s with allocation = Vehicle_map.empty; bound = [] } }

let cut waits (s : Shared.t) =
  List.map Effect.ceases waits
  @ List.map (fun (v, _) -> Effect.Stop v) (Vehicle_map.bindings s.allocation)

let ending ?(waits = []) ?(recruits = []) ?(before = []) rules label (s : Shared.t) ending =
  let is_ceased (number, _) =
    List.exists (function Effect.Cancel_timer n | Withdraw_question n -> n = number | _ -> false) before in
  let waits = List.filter (fun wait -> not (is_ceased wait)) waits in
  let left = function Effect.Release vs -> vs | _ -> [] in
  let left = if recruits = [] then [] else List.concat_map left before in
  let bound = s.bound @ List.filter (fun v -> not (List.mem v left)) recruits in
  let released = if bound = [] then [] else [ Effect.Release bound ] in
  let effects = before @ cut waits s @ released @ [ Effect.End ending ] in
  { rules; label; next = ended s ending; effects; assumed = []; otherwise = [] }
