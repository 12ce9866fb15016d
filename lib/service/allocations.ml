open Dolphin_semantics
open Dolphin_environment

(* An endless [repeat] would have no last step. *)
let longest = 2_000

let starts (t : Transition.t) =
  List.filter_map (function Effect.Start (v, p) -> Some (p.task_site, v) | _ -> None) t.effects

let run program scenario =
  let options = Scenario_world.environment ~answers:[] ~faults:Faults.none program scenario in
  let world = Scenario_world.still scenario in
  let happens (t, _) = not (Environment.is_voluntary t) in
  let rec go n found configuration outside =
    let choices = Environment.choices options program world outside configuration in
    match if n = 0 then None else Environment.find happens choices with
    | None | (exception Environment.Unclear _) -> found
    | Some ((t : Transition.t), outside) -> go (n - 1) (List.rev_append (starts t) found) t.next outside
  in
  List.rev (go longest [] (Configuration.initial program) Environment.initial)

let of_program (p : Core.program) scenario =
  let started = run p scenario in
  let vehicles site =
    List.fold_left (fun vs (s, v) -> if s = site && not (List.mem v vs) then v :: vs else vs) [] started in
  List.sort_uniq compare (List.map fst started)
  |> List.map (fun site -> (p.locations.(site), List.rev (vehicles site)))
  |> List.sort (fun ((a : Dolphin_syntax.Location.t), _) (b, _) -> compare a.start.pos_cnum b.start.pos_cnum)
