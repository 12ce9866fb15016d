open Dolphin_semantics
module Phrase = Dolphin_trace.Phrase

type failure = { time : float; vehicle : Core.vehicle; task : string; why : string }

type t = {
  ended : int;
  stopped : int;
  failures : failure list;  (* latest first *)
  ending : Configuration.ending option;
}

let start = { ended = 0; stopped = 0; failures = []; ending = None }

let transition o ~time (s : Transition.t) =
  let o =
    match s.label with
    | Done _ -> { o with ended = o.ended + 1 }
    | Fail (vehicle, task, why) -> { o with failures = { time; vehicle; task; why } :: o.failures }
    | _ -> o
  in
  let of_effect o : Effect.t -> t = function
    | Stop _ -> { o with stopped = o.stopped + 1 }
    | End ending -> { o with ending = Some ending }
    | Start _ | Set_timer _ | Cancel_timer _ | Put_question _ | Withdraw_question _ | Look_for _ | Bind _ | Release _
    | Set_connection_timeout _ | Say _ | Ask _ | Call_host _ -> o
  in
  List.fold_left of_effect o s.effects

(* {1 Lines} *)

let of_ending : Configuration.ending -> string * Tint.t = function
  | Completed -> ("completed", Tint.strong)
  | Halted _ -> ("halted", Tint.bad)
  | Failed _ -> ("failed", Tint.bad)
  | Interrupted -> ("interrupted", Tint.bad)

let tasks o =
  let some n what = if n = 0 then [] else [ Printf.sprintf "%d %s" n what ] in
  match some o.ended "done" @ some (List.length o.failures) "failed" @ some o.stopped "stopped" with
  | [] -> "none"
  | parts -> String.concat ", " parts

let most_failures = 8

let item name text = Printf.sprintf "  %-9s%s" name text

let of_failure ~colour { time; vehicle; task; why } =
  Tint.paint ~colour Tint.bad
    (item "" (Phrase.one_line (Printf.sprintf "%s: %s failed at %s: %s" vehicle task (Phrase.time time) why)))

let lines o ~now ~journal ~colour =
  match o.ending with
  | None -> []
  | Some ending ->
    let how, tint = of_ending ending in
    let hidden = List.length o.failures - most_failures in
    let failures = List.filteri (fun i _ -> i < most_failures) (List.rev o.failures) in
    (Tint.paint ~colour tint (Printf.sprintf "%s after %s" how (Phrase.time now)) :: [ item "tasks" (tasks o) ])
    @ List.map (of_failure ~colour) failures
    @ (if hidden > 0 then [ item "" (Printf.sprintf "and %d more" hidden) ] else [])
    @ List.map (item "journal") (Option.to_list journal)
