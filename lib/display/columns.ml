open Dolphin_semantics
module Phrase = Dolphin_trace.Phrase
module Location = Dolphin_syntax.Location

let program_column = "program"
let widest = 40

(* Who a transition is about, what happened, and where the program says so, as far as it can be told. *)
type row = { actor : string; text : string; at : Location.t option; assumed : World.assumption list }

let site_of (label : Label.t) (t : Transition.t) before =
  let task v = Option.map (fun (p : Core.platform_task) -> p.task_site) (Vehicle_map.find_opt v before) in
  match label, t.next.control with
  | Start (v, _), _ ->
    Option.map
      (fun (p : Core.platform_task) -> p.task_site)
      (Vehicle_map.find_opt v t.next.shared.allocation)
  | (Done (v, _) | Fail (v, _, _)), _ -> task v
  | _, (Script m | Waiting (m, _) | Executing (m, _)) -> Some (Machine.site m)
  | _, Ended (Failed fault) -> Some fault.site
  | _, Ended (Completed | Halted _ | Interrupted) -> None

let row (program : Core.program) before (t : Transition.t) =
  let at site = Fault.location program (Fault.make site "") in
  let actor =
    match t.label with Start (v, _) | Done (v, _) | Fail (v, _, _) -> v | _ -> program_column
  in
  let text =
    match t.label with
    | Start (_, name) -> "starts " ^ name
    | Done (_, name) -> "ends " ^ name
    | Fail (_, name, why) -> Printf.sprintf "fails in %s: %s" name why
    | Bind vs -> "picks " ^ Wording.vehicles vs
    | label -> Format.asprintf "%a" Label.pp label
  in
  { actor; text = Phrase.one_line text; at = Option.bind (site_of t.label t before) at; assumed = t.assumed }

let rows program run =
  let add (before, rows) (t : Transition.t) =
    let is_shown = match t.label with Silent -> t.assumed <> [] | _ -> true in
    let rows = if is_shown then row program before t :: rows else rows in
    (t.next.shared.allocation, rows)
  in
  List.rev (snd (List.fold_left add (Vehicle_map.empty, []) run))

let shortened text =
  if Phrase.width text <= widest then text
  else
    match Value.items (String text) with
    | None -> text
    | Some characters ->
      String.concat "" (List.map Value.to_string (Array.to_list (Array.sub characters 0 (widest - 3)))) ^ "..."

let lines ?(first = 1) program run =
  let rows = rows program run in
  let actors =
    List.fold_left (fun actors row -> if List.mem row.actor actors then actors else actors @ [ row.actor ])
      [ program_column ] rows
  in
  let width actor =
    List.fold_left
      (fun width row -> if row.actor = actor then max width (Phrase.width (shortened row.text)) else width)
      (Phrase.width actor) rows
  in
  let widths = List.map width actors in
  let number = String.length (string_of_int (first + List.length rows)) in
  let print head cells tail =
    let cells = List.map2 Phrase.pad widths cells in
    let line = String.concat "  " ((Phrase.pad (number + 1) head :: cells) @ [ tail ]) in
    let rec trimmed n = if n > 0 && line.[n - 1] = ' ' then trimmed (n - 1) else String.sub line 0 n in
    trimmed (String.length line)
  in
  let body i row =
    let cell actor = if actor = row.actor then shortened row.text else "" in
    let where =
      match row.at with
      | Some at -> Printf.sprintf "%s:%d" (Filename.basename (Location.file at)) (Location.line at)
      | None -> ""
    in
    let n = string_of_int (first + i) in
    let assumed a =
      String.make (number + 3) ' ' ^ "if " ^ Phrase.one_line (Format.asprintf "%a" World.pp_assumption a)
    in
    print (String.make (number - String.length n) ' ' ^ n) (List.map cell actors) where :: List.map assumed row.assumed
  in
  print "" actors "where" :: List.concat (List.mapi body rows)
