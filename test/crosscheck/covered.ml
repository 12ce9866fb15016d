open Dolphin_semantics
open Dolphin_tlc

let excused : Rule.t list = []

type counted = { rule : Rule.t; taken : int; derivations : int }

(* [Take_SEQ_1] is that of [SEQ-1]. *)
let action rule = "Take_" ^ String.concat "_" (String.split_on_char '-' (Rule.name rule))

let count installation prepared =
  let counted (batch : Batch.t) =
    let one rule =
      let is_its (c : Coverage.count) = c.action = action rule in
      let taken = match List.find_opt is_its batch.counted with Some c -> c.taken | None -> 0 in
      { rule; taken; derivations = Option.value (List.assoc_opt (Rule.name rule) batch.used) ~default:0 }
    in
    (List.map one Rule.all, batch)
  in
  Result.map counted (Batch.run ~coverage:true installation ~specification:Translated.specification prepared)

let rules_where f counts = List.filter_map (fun c -> if f c then Some c.rule else None) counts
let miscounted = List.filter (fun c -> c.taken < c.derivations || (c.taken > 0 && c.derivations = 0))
let missing = rules_where (fun c -> c.taken = 0 && not (List.mem c.rule excused))
let no_longer_excused = rules_where (fun c -> c.taken > 0 && List.mem c.rule excused)
