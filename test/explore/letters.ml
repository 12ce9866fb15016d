(* A position of a run, as formulas see it: the transition that led there, if any, and the state. *)

open Dolphin_semantics
open Dolphin_explore
module Linear = Test_support.Linear

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

(* Of a run without a cycle the last position stays, without its transition. *)
let word program (run : Search.run) : _ Linear.word =
  let position (t : Transition.t) = (Some t, t.next) in
  let steps = (None, Configuration.initial program) :: List.map position run.steps in
  let stays = (None, snd (List.nth steps (List.length steps - 1))) in
  let cycle = if run.cycle = [] then [ stays ] else List.map position run.cycle in
  { letters = Array.of_list (steps @ cycle); back = List.length steps }
