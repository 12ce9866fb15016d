open Dolphin_semantics
module I = Interpreter

let machine (c : Configuration.t) =
  match c.control with Script m | Waiting (m, _) | Executing (m, _) -> Some m | Ended _ -> None

(* The vehicles that may be held or run a task. *)
let vehicles world (c : Configuration.t) =
  let named = match c.control with Executing (_, r) -> Residual.named r | Script _ | Waiting _ | Ended _ -> [] in
  let heard = List.map (fun (v : World.vehicle_state) -> v.id) (World.vehicles world) in
  let running = List.map fst (Vehicle_map.bindings c.shared.allocation) in
  List.sort_uniq String.compare (heard @ running @ c.shared.bound @ named)

let transitions ?answer program world event (c : Configuration.t) =
  let vehicles = vehicles world c in
  let code = Interpretation.code program ~vehicles ~machine:(machine c) ~answer:(fun _ -> answer) in
  let found = I.cderivations Terms.names code world (Option.map Terms.event event) (Terms.configuration c) in
  List.map (Terms.transition ~vehicles) found

let internal program world c = List.to_seq (transitions program world None c)

let accept program world (c : Configuration.t) (event : Transition.event) =
  let answer = match event with Answered { code; text = _ } -> Some code | _ -> None in
  match transitions ?answer program world (Some event) c, event, c.control with
  | t :: _, _, _ -> Ok t
  | [], Answered _, Waiting (_, Ask _) -> Error (Transition.Bad_answer "it has no value, or does more than compute one")
  | [], _, _ -> Error Transition.Not_awaited
