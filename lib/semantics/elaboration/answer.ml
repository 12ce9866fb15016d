let event program text : (Transition.event, Transition.refusal) result =
  match Elaborate.answer program text with
  | Ok code -> Ok (Answered { text; code })
  | Error why -> Error (Bad_answer why)
