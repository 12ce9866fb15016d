open Dolphin_semantics
open Dolphin_tlc

type counted = { rule : Rule.t; taken : int; derivations : int }

(* [Take_SEQ_1] is that of [SEQ-1]. *)
let action rule = "Take_" ^ String.concat "_" (String.split_on_char '-' (Rule.name rule))

let count installation prepared =
  let counted (batch : Batch.t) =
    let one rule =
      let is_its (c : Action_counts.count) = c.action = action rule in
      let taken = match List.find_opt is_its batch.counted with Some c -> c.taken | None -> 0 in
      { rule; taken; derivations = batch.used (Rule.name rule) }
    in
    (List.map one Rule.all, batch)
  in
  Result.map counted (Batch.run ~coverage:true installation ~specification:Translated.specification prepared)

let miscounted = List.filter (fun c -> c.taken <> c.derivations)
let missing counts = List.filter_map (fun c -> if c.taken = 0 then Some c.rule else None) counts
