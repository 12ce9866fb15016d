(* A position of a run, as formulas see it: the transition that led there, if any, and the state. *)

open Dolphin_explore

let holds program world =
  let known = Hashtbl.create 8 in
  let proposition text =
    match Hashtbl.find_opt known text with
    | Some p -> p
    | None ->
      let p = match Proposition.of_string program text with Ok p -> p | Error why -> failwith why in
      Hashtbl.add known text p;
      p
  in
  fun (transition, c) text ->
    let p = proposition text in
    if Proposition.needs_action p then
      Option.fold ~none:false ~some:(fun t -> Proposition.holds_after p (Proposition.observed t)) transition
    else Result.get_ok (Proposition.holds_in program world p c)
