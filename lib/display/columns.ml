open Dolphin_semantics
module Phrase = Dolphin_trace.Phrase
module Location = Dolphin_syntax.Location

let program_column = "program"
let widest = 40  (* characters of a cell *)

(* The vehicle of a transition, its deed, and its place in the program, as far as they are known. *)
type row = {
  actor : string;
  text : string;
  at : Location.t option;
  words : string;  (* the log's words, where the label is short *)
  assumed : World.assumption list;
}

(* The code of a step that may have such a label, of all that has begun: from the outside in, left to right. *)
let code_for (label : Label.t) (c : Configuration.t) =
  let code : Residual.t -> Core.closure list = fun r ->
    match label, r with
    | Act _, Action c | Check _, Condition c | Cut _, Until (_, c, _) | Make, Made { code = c; _ } -> [ c ]
    | Check _, (One_of bs | All_of (None, bs)) -> List.map (fun (b : Residual.branch) -> b.guard) bs
    | Check _, Repeat { round = None; again } -> Option.to_list again.until
    | _, _ -> []
  in
  match c.control with
  | Executing (_, r) -> Residual.fold_active (fun found r -> found @ code r) [] r
  | Script _ | Waiting _ | Ended _ -> []

(* The place of the step's code: the first that it has left behind; or all possible ones, if they are at one place. *)
let site_of_code (label : Label.t) before (t : Transition.t) =
  let site (c : Core.closure) = c.lambda.lambda_site in
  let sites c = List.map site (code_for label c) in
  let count site = List.fold_left (fun n site' -> if site = site' then n + 1 else n) 0 in
  let known = Option.fold ~none:[] ~some:sites before and left = sites t.next in
  match List.find_opt (fun site -> count site left < count site known) known, List.sort_uniq Int.compare known with
  | Some site, _ | None, [ site ] -> Some site
  | None, ([] | _ :: _ :: _) -> None

let site_of (label : Label.t) (t : Transition.t) ~code before =
  let task v = Option.map (fun (p : Core.platform_task) -> p.task_site) (Vehicle_map.find_opt v before) in
  match label, t.next.control with
  | _, (Script _ | Waiting _ | Executing _) when Option.is_some code -> code
  | Start (v, _), _ ->
    Option.map
      (fun (p : Core.platform_task) -> p.task_site)
      (Vehicle_map.find_opt v t.next.shared.allocation)
  | (Done (v, _) | Fail (v, _, _)), _ -> task v
  | _, (Script m | Waiting (m, _) | Executing (m, _)) -> Some (Machine.site m)
  | _, Ended (Failed fault) -> Some fault.site
  | _, Ended (Completed | Halted _ | Interrupted) -> None

(* The text of the condition that the transition left behind, if it is clear which one. *)
let condition program ~source (before : Configuration.t option) (t : Transition.t) =
  let guards (c : Configuration.t) =
    match c.control with Executing (_, r) -> Dolphin_runtime.Driver.guards r | Script _ | Waiting _ | Ended _ -> []
  in
  let left = List.map (fun (g : Core.closure) -> g.lambda.id) (guards t.next) in
  let is_gone (g : Core.closure) = not (List.mem g.lambda.id left) in
  match List.filter is_gone (Option.fold ~none:[] ~some:guards before) with
  | [ g ] -> Waiting.text program ~source g.lambda.code.site
  | [] | _ :: _ :: _ -> None

let words program ~source before (t : Transition.t) =
  match t.label, condition program ~source before t with
  | Check [], Some text -> Printf.sprintf "sees that %s holds" text
  | _, (Some _ | None) -> Log.words t

let row (program : Core.program) ~source (before : Configuration.t option) (t : Transition.t) =
  let running = Option.fold ~none:Vehicle_map.empty ~some:(fun (c : Configuration.t) -> c.shared.allocation) before in
  let at site = Fault.location program (Fault.make site "") in
  let is_in_program at = Location.file at <> Dolphin_syntax.Prelude.file in
  let is_own site = Option.fold ~none:false ~some:is_in_program (at site) in
  let code = Option.bind (site_of_code t.label before t) (fun site -> if is_own site then Some site else None) in
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
  { actor; text = Phrase.one_line text; at = Option.bind (site_of t.label t ~code running) at;
    words = words program ~source before t; assumed = t.assumed }

let place row =
  match row.at with
  | Some at -> Printf.sprintf "%s:%d" (Filename.basename (Location.file at)) (Location.line at)
  | None -> ""

let is_shown (t : Transition.t) = match t.label with Silent -> t.assumed <> [] | _ -> true

let rows program ~source run =
  let add (before, rows) (t : Transition.t) =
    let rows = if is_shown t then row program ~source before t :: rows else rows in
    (Some t.next, rows)
  in
  List.rev (snd (List.fold_left add (None, []) run))

let shortened widest text =
  if Phrase.width text <= widest then text else fst (Phrase.split (widest - 3) text) ^ "..."

let width_of_all texts = List.fold_left (fun width text -> max width (Phrase.width text)) 0 texts

(* Below the row, beside heads of [number] characters. *)
let assumptions ~number row =
  let assumed a =
    String.make (number + 3) ' ' ^ "if " ^ Phrase.one_line (Format.asprintf "%a" World.pp_assumption a) in
  List.map assumed row.assumed

(* As a table whose cells have at most [widest] characters, with a last column of [words] characters, if any; each row
   has its text of [heads]. *)
let table ~heads ~widest ~words rows =
  let shortened_to = shortened in
  let shortened = shortened widest in
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
  let number = width_of_all heads in
  let wider_place width row = max width (Phrase.width (place row)) in
  let widest_place = List.fold_left wider_place (Phrase.width "where") rows in
  let print head cells where said =
    let cells = List.map2 Phrase.pad widths cells in
    let tail = match words with Some n -> [ Phrase.pad widest_place where; shortened_to n said ] | None -> [ where ] in
    let line = String.concat "  " ((Phrase.pad (number + 1) head :: cells) @ tail) in
    let rec trimmed n = if n > 0 && line.[n - 1] = ' ' then trimmed (n - 1) else String.sub line 0 n in
    trimmed (String.length line)
  in
  let body n row =
    let cell actor = if actor = row.actor then shortened row.text else "" in
    let head = String.make (number - Phrase.width n) ' ' ^ n in
    print head (List.map cell actors) (place row) row.words :: assumptions ~number row
  in
  print "" actors "where" "in words" :: List.concat (List.map2 body heads rows)

let least_words = 24
let narrowest = 12
let width = width_of_all

(* The vehicle has a column of its own, if columns for all do not fit. *)
let listing ~heads ~columns rows =
  let number = width heads in
  let cells widest head row =
    [ String.make (number - Phrase.width head) ' ' ^ head ^ " "; row.actor; shortened widest row.text; place row ] in
  let table widest = Text_table.lines [ ""; "who"; "what"; "where" ] (List.map2 (cells widest) heads rows) in
  let rec fitting widest =
    if widest <= narrowest || width (table widest) <= columns then widest else fitting (widest - 1) in
  match table (fitting widest) with
  | [] -> []
  | names :: lines -> names :: List.concat (List.map2 (fun line row -> line :: assumptions ~number row) lines rows)

(* The reader of a narrow table does not need the log's words, but the names of vehicles and tasks. *)
let lines ?(first = 1) ?heads ?columns ~source program run =
  let rows = rows program ~source run in
  let without_assumed = List.map (fun row -> { row with assumed = [] }) rows in
  let is_row (t, _) = is_shown t in
  let heads =
    match heads with
    | Some heads -> List.map snd (List.filter is_row (List.combine run heads))
    | None ->
      let width = String.length (string_of_int (first + List.length rows)) in
      List.mapi (fun i _ -> Printf.sprintf "%*d" width (first + i)) rows
  in
  let table = table ~heads in
  match columns with
  | None -> table ~widest ~words:None rows
  | Some columns ->
    let width widest = width (table ~widest ~words:None without_assumed) in
    let rec fitting widest = if widest <= narrowest || width widest <= columns then widest else fitting (widest - 1) in
    let widest = fitting (min columns (max widest (width_of_all (List.map (fun row -> row.text) rows)))) in
    let has_words = List.exists (fun row -> row.words <> "") rows in
    let left = columns - width widest - 2 in
    if left < -2 then listing ~heads ~columns rows
    else table ~widest ~words:(if has_words && left >= least_words then Some left else None) rows
