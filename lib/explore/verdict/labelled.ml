open Dolphin_semantics
open Dolphin_environment

type state = Configuration.t * Environment.t

let start program = (Configuration.initial program, Environment.initial)
let same (c, e) (c', e') = Environment.compare e e' = 0 && Configuration.equal c c'
let label (t : Transition.t) = Format.asprintf "%a" Label.pp t.label

let step options program world wanted (((c, e) : state), run) =
  let continued ((t : Transition.t), e') = if label t = wanted then Some ((t.next, e'), t :: run) else None in
  List.of_seq (Seq.filter_map continued (Environment.choices options program world e c))

(* One run to each state. *)
let distinct reached =
  let add kept ((s, _) as r) = if List.exists (fun (s', _) -> same s s') kept then kept else r :: kept in
  List.rev (List.fold_left add [] reached)

let follow options program world s labels =
  let next reached wanted = distinct (List.concat_map (step options program world wanted) reached) in
  List.map (fun (s, run) -> (s, List.rev run)) (List.fold_left next [ (s, []) ] labels)

let back options program world (c, e) target =
  let leads ((t : Transition.t), e') = same (t.next, e') target in
  Option.map fst (Environment.find leads (Environment.choices options program world e c))
