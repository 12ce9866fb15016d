open Dolphin_semantics

let between options program world space states =
  let step a b =
    let c, outside = Space.state space a and c', outside' = Space.state space b in
    let leads ((t : Transition.t), e) = Environment.compare e outside' = 0 && Configuration.equal t.next c' in
    match List.find_opt leads (Environment.choices options program world outside c) with
    | Some (t, _) -> t
    | None -> Fmt.invalid_arg "Replay.between: no transition from state %d to state %d" a b
  in
  let rec go = function
    | a :: (b :: _ as rest) ->
      let t = step a b in
      t :: go rest
    | [ _ ] | [] -> []
  in
  go states

let shortest space i =
  let rec back i states = if i = 0 then 0 :: states else back (Space.parent space i) (i :: states) in
  back i []
