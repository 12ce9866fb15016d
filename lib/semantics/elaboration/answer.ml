let event program text : (Transition.event, Transition.refusal) result =
  match Elaborate.answer program text with
  | Ok code -> Ok (Answered { text; code })
  | Error why -> Error (Bad_answer why)

let confirmation text =
  match String.lowercase_ascii (String.trim text) with
  | "yes" | "y" | "true" -> Some true
  | "no" | "n" | "false" -> Some false
  | _ -> None

let confirmation_of_value : Core.value -> bool option = function
  | Boolean yes -> Some yes
  | String text -> confirmation text
  | _ -> None
