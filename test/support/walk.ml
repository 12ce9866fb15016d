open Dolphin_semantics

type step = { before : Configuration.t; transition : Transition.t }

let choices = QCheck2.Gen.(list_size (int_range 1 80) (int_bound 9_999))

let run ~choices program world =
  let rec go c choices walked =
    match choices with
    | [] -> List.rev walked
    | choice :: choices -> (
        let interruption = choice mod 100 = 99 in
        match Graph.outcomes ~interruption program world c with
        | [] -> List.rev walked
        | outcomes ->
          let transition = List.nth outcomes (choice mod List.length outcomes) in
          go transition.next choices ({ before = c; transition } :: walked))
  in
  go (Configuration.initial program) choices []
