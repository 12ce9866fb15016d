type t = int list

let is_same (a : Timed.step) (b : Timed.step) =
  let t = a.transition and u = b.transition in
  a.due = b.due && t.rules = u.rules && t.assumed = u.assumed
  && Dolphin_semantics.Label.equal t.label u.label
  && Timed.equal a.next b.next

let of_run options state steps =
  let choose (state, choices) (step : Timed.step) =
    let rec place i = function
      | other :: rest -> if is_same step other then i else place (i + 1) rest
      | [] -> invalid_arg "Choices.of_run: a step that is not possible"
    in
    (step.next, place 0 (Timed.all_steps options state) :: choices)
  in
  List.rev (snd (List.fold_left choose (state, []) steps))

let run options state choices =
  let take (state, steps) choice =
    let step = List.nth (Timed.all_steps options state) choice in
    (step.next, step :: steps)
  in
  List.rev (snd (List.fold_left take (state, []) choices))
