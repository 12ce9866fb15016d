open Dolphin_semantics
open Dolphin_environment

(* Of several ways to take a step, [Environment.choices] has one with the fewest late vehicles first. Of the ways in
   which a pick fails it has one; they differ in the text of the error. *)
let after_run ~tick (options : Environment.options) program world (c, outside) steps =
  let options = { options with most_faults = Some max_int } in
  let take (c, outside) (t : Transition.t) =
    tick ();
    let broken (t : Transition.t) = Property.broken_by_end program t.rules t.next in
    let is_same ((t' : Transition.t), _) = Label.equal t'.label t.label && Configuration.equal t'.next t.next in
    let ends_alike (t', _) = broken t <> None && broken t' = broken t in
    let choices = Environment.choices_like t options program world outside c in
    match Environment.find is_same choices with
    | Some (_, outside) -> (t.next, outside)
    | None -> (
        match Environment.find ends_alike choices with
        | Some (_, outside) -> (t.next, outside)
        | None -> invalid_arg "Fault_count: not a run")
  in
  List.fold_left take (c, outside) steps

let of_run ~tick options program world start steps =
  let _, outside = after_run ~tick options program world start steps in
  Environment.spent outside - Environment.spent (snd start)

(* Vehicles that could be recruited there, and are not. *)
let of_deadlock ~tick options program world start steps =
  let c, outside = after_run ~tick options program world start steps in
  let awaited ((t : Transition.t), _) = match t.label with Recruit v -> Some v | _ -> None in
  let choices = List.of_seq (Environment.choices options program world outside c) in
  let counts v = not (List.mem v (Environment.lost outside) || List.mem v (Environment.late outside)) in
  let absent = List.filter counts (List.sort_uniq String.compare (List.filter_map awaited choices)) in
  Environment.spent outside - Environment.spent (snd start) + List.length absent
