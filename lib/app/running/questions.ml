open Dolphin_semantics
module Scenario = Dolphin_scenario.Scenario

type person = {
  asked : string -> unit;
  answer : string -> (string, string) result Lwt.t;
  answered : string -> unit;
  refused : string -> unit;
}

let nobody =
  { asked = ignore; answer = (fun _ -> Lwt.return (Error "nobody is there")); answered = ignore; refused = ignore }

(* {1 The fleet's answers} *)

type fleet = {
  scenario : Scenario.t;
  asked : (string, int) Hashtbl.t;  (* how often it answered each prompt *)
  mutable refused : (string * string) list;  (* its answers that were no good, with their prompts *)
}

let times fleet prompt = Option.value (Hashtbl.find_opt fleet.asked prompt) ~default:0

let same found text =
  let confirmation = Answer.confirmation in
  found = text || (confirmation found <> None && confirmation found = confirmation text)

(* It gave this answer before, or another source did. *)
let count fleet (prompt, text) =
  let rec find n =
    match Scenario.answer fleet.scenario prompt n with
    | Some found when same found text -> Hashtbl.replace fleet.asked prompt (n + 1)
    | Some _ -> find (n + 1)
    | None -> ()
  in
  find (times fleet prompt)

let answer_of fleet prompt =
  let n = times fleet prompt in
  match Scenario.answer fleet.scenario prompt n with
  | Some text when not (List.mem (prompt, text) fleet.refused) ->
    Hashtbl.replace fleet.asked prompt (n + 1);
    Some text
  | Some _ | None -> None

(* {1 All of them} *)

let console person ~answered ~answers ~scenario =
  let fleet = { scenario; asked = Hashtbl.create 8; refused = [] } in
  List.iter (count fleet) answered;
  let remaining = ref answers in
  let latest = ref None in  (* the fleet's answer just given, with its prompt *)
  let give text =
    person.answered text;
    Lwt.return (Ok text)
  in
  let ask prompt =
    person.asked prompt;
    latest := None;
    match !remaining with
    | text :: others ->
      remaining := others;
      give text
    | [] -> (
        match answer_of fleet prompt with
        | Some text ->
          latest := Some (prompt, text);
          give text
        | None -> person.answer prompt)
  in
  let refused why =
    Option.iter (fun answer -> fleet.refused <- answer :: fleet.refused) !latest;
    person.refused why
  in
  { Dolphin_runtime.Console.say = ignore; ask; refused }
