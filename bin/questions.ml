open Dolphin_runtime
open Lwt.Infix
module Scenario = Dolphin_scenario.Scenario

type shown = { ask : string -> unit; answered : string option -> unit; refused : string -> unit }

(* What is typed at a terminal stands there already. *)
let echo text = if Unix.isatty Unix.stdin then None else Some text

let console shown ~answered ~answers ~scenario =
  let typed = Console.scripted ~output:ignore ~answers:[] () in
  let remaining = ref answers in
  let asked = Hashtbl.create 8 in  (* how often the fleet was asked each prompt *)
  let latest = ref None in  (* the fleet's answer just given, with its prompt *)
  let refused_by_fleet = ref [] in
  (* Where the fleet's answers stand after it gave this one, if it did. *)
  let count (prompt, text) =
    let rec find n =
      match Scenario.answer scenario prompt n with
      | Some found when found = text -> Hashtbl.replace asked prompt (n + 1)
      | Some _ -> find (n + 1)
      | None -> ()
    in
    find (Option.value (Hashtbl.find_opt asked prompt) ~default:0)
  in
  List.iter count answered;
  let of_fleet prompt =
    let n = Option.value (Hashtbl.find_opt asked prompt) ~default:0 in
    match Scenario.answer scenario prompt n with
    | Some text when not (List.mem (prompt, text) !refused_by_fleet) ->
      Hashtbl.replace asked prompt (n + 1);
      latest := Some (prompt, text);
      Some text
    | Some _ | None -> None
  in
  let give text =
    shown.answered (Some text);
    Lwt.return (Ok text)
  in
  let ask prompt =
    shown.ask prompt;
    latest := None;
    match !remaining with
    | text :: others ->
      remaining := others;
      give text
    | [] -> (
        match of_fleet prompt with
        | Some text -> give text
        | None ->
          typed.ask prompt >|= fun reply ->
          Result.iter (fun text -> shown.answered (echo text)) reply;
          reply)
  in
  let refused why =
    Option.iter (fun answer -> refused_by_fleet := answer :: !refused_by_fleet) !latest;
    shown.refused why
  in
  { Console.say = ignore; ask; refused }
