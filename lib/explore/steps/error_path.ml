open Dolphin_semantics
open Component

let lifted step =
  let level = ref 0 in
  let rec climb path n (change : Residual.change) =
    match change.outcome, path.outer with
    | (Next _ | Finished), _ ->
      level := n;
      change
    | Failed _, None -> change
    | Failed _, Some outer ->
      let through change context = Residual.change_within context change in
      climb outer (n + 1) (List.fold_left through change path.contexts)
    | Handling h, _ ->
      let ignored () = climb path n (h.ignored ()) and propagated fault = climb path n (h.propagated fault) in
      { change with outcome = Handling { h with ignored; propagated } }
  in
  let continue reply = climb step.home 0 (step.source.Residual.continue reply) in
  ({ step.source with continue }, level)
