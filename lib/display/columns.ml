open Dolphin_semantics
module Phrase = Dolphin_trace.Phrase
module Location = Dolphin_syntax.Location

let program_column = "program"
let widest = 40  (* characters of a cell, where columns are few *)

(* The vehicle of a transition, its deed, and its place in the program, as far as they are known. *)
type row = {
  actor : string;
  text : string;
  at : Location.t option;
  words : string;  (* the log's words, if the label is short *)
  assumed : World.assumption list;
  changed : (string * string) list;
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

(* The place of the code of a failed step: among the possible steps, the one that fails so. *)
let site_of_broken program (c : Configuration.t) (t : Transition.t) =
  let code (type a) (offer : a Task_rules.offer) =
    match offer with
    | Perform c -> Some c
    | Check c -> Some c
    | Guard_false c -> Some c
    | Guard_either c -> Some c
    | Guard_values c -> Some c
    | Measure c -> Some c
    | Make (c, _, _) -> Some c
    | Start _ | Allocate _ | End_of _ | Expiry_of _ | Answer_to _ | Recruit_for _ -> None
  in
  let world = World.at Any World.empty in
  let of_step m r (Task_rules.Step { offer; _ } as step) =
    match code offer, Local_step.internal program world c.shared step with
    | Some (code : Core.closure), Decided (Some local)
      when Label.equal local.named t.label && Configuration.equal (Local_step.conclude m r local).next t.next ->
      Some code.lambda.lambda_site
    | _, (Decided _ | Open _ | Unclear _) -> None
  in
  match c.control with
  | Executing (m, r) ->
    let first found step = if found = None then of_step m r step else found in
    Seq.fold_left first None (Task_rules.marked_steps Alone r)
  | Script _ | Waiting _ | Ended _ -> None

(* The waits that a step with such a label may end or begin, by number, with their places. *)
let waits_for (label : Label.t) (c : Configuration.t) =
  let wait : Residual.t -> (Residual.timer * Core.site) option = fun r ->
    match label, r with
    | Time_out, Idle { timer; site; _ } -> Some (timer, site)
    | Time_out, During { started = true; timer; on_cut = Completes site | Fails site; _ }
    | Set_time _, During { started = false; timer; on_cut = Completes site | Fails site; _ } -> Some (timer, site)
    | (Answer _ | No_answer), Confirm { question; site; _ } -> Some (question, site)
    | Recruit _, Recruit { number; site; _ } -> Some (number, site)
    | _, _ -> None
  in
  match c.control with
  | Executing (_, r) ->
    List.rev (Residual.fold_active (fun found r -> match wait r with Some w -> w :: found | None -> found) [] r)
  | Script _ | Waiting _ | Ended _ -> []

(* The place of the wait that the step ends: it is gone, or begins again in the next round of a [repeat]; waits that
   the step gives up are cancelled. *)
let site_of_wait (label : Label.t) before (t : Transition.t) =
  let numbers number = List.filter_map number t.effects in
  let begun = numbers (function Effect.Set_timer (n, _) | Put_question (n, _) -> Some n | _ -> None) in
  let ceased = numbers (function Effect.Cancel_timer n | Withdraw_question n -> Some n | _ -> None) in
  let left = Hashtbl.create 16 in
  List.iter (fun (n, _) -> Hashtbl.replace left n ()) (waits_for label t.next);
  let is_ended (n, _) = (List.mem n begun || not (Hashtbl.mem left n)) && not (List.mem n ceased) in
  Option.map snd (List.find_opt is_ended (waits_for label before))

let site_of_step program (label : Label.t) before (t : Transition.t) =
  match label, before with
  | (Time_out | Set_time _ | Answer _ | No_answer | Recruit _), Some c -> site_of_wait label c t
  | Broken _, Some c -> site_of_broken program c t
  | _, _ -> site_of_code label before t

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

(* The label of a failed step gives the reason already. *)
let words program ~source before (t : Transition.t) =
  match t.label, condition program ~source before t with
  | Check [], Some text -> Printf.sprintf "sees that %s holds" text
  | Broken _, _ -> ""
  | _, (Some _ | None) -> Log.words t

(* Lists may hold their parts many times over: only short ones are printed. *)
let shown_parts = 1_000

(* The variables that the step assigned, except for functions and tasks. *)
let changed (program : Core.program) (before : Configuration.t option) (t : Transition.t) =
  let before = Option.value before ~default:(Configuration.initial program) in
  let is_data : Core.value -> bool = function Closure _ | Task _ -> false | _ -> true in
  let of_variable (i, x) =
    let is_same = Option.fold (Store.find i before.shared.store) ~none:false ~some:(fun y -> Value.compare x y = 0) in
    if is_same || not (is_data x) then None
    else
      let is_short = Value.has_at_most shown_parts x in
      Some (program.global_names.(i), if is_short then Format.asprintf "%a" Value.pp (Value.canonical x) else "...")
  in
  List.filter_map of_variable (Store.bindings t.next.shared.store)

let row ?shown (program : Core.program) ~source (before : Configuration.t option) (t : Transition.t) =
  let running = Option.fold ~none:Vehicle_map.empty ~some:(fun (c : Configuration.t) -> c.shared.allocation) before in
  let at site = Fault.location program (Fault.make site "") in
  let is_in_program at = Location.file at <> Dolphin_syntax.Prelude.file in
  let is_own site = Option.fold ~none:false ~some:is_in_program (at site) in
  let own site = if is_own site then Some site else None in
  let code = Option.bind (site_of_step program t.label before t) own in
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
    words = words program ~source before t; assumed = t.assumed;
    changed = changed program (if shown = None then before else shown) t }

let place row =
  match row.at with
  | Some at -> Phrase.one_line (Printf.sprintf "%s:%d" (Filename.basename (Location.file at)) (Location.line at))
  | None -> ""

let is_shown (t : Transition.t) = match t.label with Silent -> t.assumed <> [] | _ -> true

(* Assignments of steps without a row stand beside the next one. *)
let rows ?before program ~source run =
  let add (before, shown, rows) (t : Transition.t) =
    if is_shown t then (Some t.next, Some t.next, row ?shown program ~source before t :: rows)
    else (Some t.next, shown, rows)
  in
  let start = Option.value before ~default:(Configuration.initial program) in
  let _, _, rows = List.fold_left add (before, Some start, []) run in
  List.rev rows

let shortened widest text =
  if Phrase.width text <= widest then text else fst (Phrase.split (widest - 3) text) ^ "..."

let width_of_all texts = List.fold_left (fun width text -> max width (Phrase.width text)) 0 texts

(* Below the row, beside heads of [number] characters: its assumptions, and a remark. *)
let notes ~number (row, remark) =
  let line text = String.make (number + 3) ' ' ^ text in
  let assumed a = line ("if " ^ Phrase.one_line (Format.asprintf "%a" World.pp_assumption a)) in
  List.map assumed row.assumed @ List.map line (Option.to_list remark)

let changes row = String.concat ", " (List.map (fun (name, x) -> Phrase.one_line (name ^ " = " ^ x)) row.changed)

let below ~number ~widest row =
  if row.changed = [] then [] else [ String.make (number + 3) ' ' ^ shortened widest (changes row) ]

(* The place of a row's assignments, if any row has assignments. *)
type beside = In_column | Below | Nowhere

(* As a table whose columns have at most [widest] characters, with a last one of [words] characters, if any; each row
   has its text of [heads], and its remark. Unless they are [cut], longer texts move the rest of their row to the
   right. *)
let table ?(cut = true) ~heads ~remarks ~widest ~words ~beside rows =
  let shortened_to = shortened in
  let shortened text = if cut then shortened_to widest text else text in
  let room width text = max width (min widest (Phrase.width text)) in
  let actors =
    List.fold_left (fun actors row -> if List.mem row.actor actors then actors else actors @ [ row.actor ])
      [ program_column ] rows
  in
  let width actor =
    let wider width row = if row.actor = actor then room width row.text else width in
    List.fold_left wider (Phrase.width actor) rows
  in
  let widths = List.map width actors in
  let number = width_of_all heads in
  let wider_place width row = max width (Phrase.width (place row)) in
  let widest_place = List.fold_left wider_place (Phrase.width "where") rows in
  let changes row = shortened (changes row) in
  let widest_change = List.fold_left (fun width row -> room width (changes row)) (Phrase.width "variables") rows in
  let print head cells where changed said =
    let cells = List.map2 Phrase.pad widths cells in
    let changed = match beside with In_column -> [ Phrase.pad widest_change changed ] | Below | Nowhere -> [] in
    let said = match words with Some n -> [ shortened_to n said ] | None -> [] in
    let tail = (Phrase.pad widest_place where :: changed) @ said in
    let line = String.concat "  " ((Phrase.pad (number + 1) head :: cells) @ tail) in
    let rec trimmed n = if n > 0 && line.[n - 1] = ' ' then trimmed (n - 1) else String.sub line 0 n in
    trimmed (String.length line)
  in
  let body n (row, remark) =
    let cell actor = if actor = row.actor then shortened row.text else "" in
    let head = String.make (number - Phrase.width n) ' ' ^ n in
    let below = if beside = Below then below ~number ~widest:(4 * widest) row else [] in
    (print head (List.map cell actors) (place row) (changes row) row.words :: below) @ notes ~number (row, remark)
  in
  print "" actors "where" "variables" "in words" :: List.concat (List.map2 body heads (List.combine rows remarks))

let least_words = 24
let narrowest = 12

(* Labels that variables beside leave. *)
let readable = 24
let width = width_of_all

(* The vehicle has a column of its own, if columns for all do not fit. *)
let listing ~heads ~remarks ~columns rows =
  let number = width heads in
  let cells widest head row =
    [ String.make (number - Phrase.width head) ' ' ^ head ^ " "; row.actor; shortened widest row.text; place row ] in
  let table widest = Text_table.lines [ ""; "who"; "what"; "where" ] (List.map2 (cells widest) heads rows) in
  let rec fitting widest =
    if widest <= narrowest || width (table widest) <= columns then widest else fitting (widest - 1) in
  let line line (row, remark) =
    (line :: below ~number ~widest:(columns - number - 3) row) @ notes ~number (row, remark) in
  match table (fitting widest) with
  | [] -> []
  | names :: lines -> names :: List.concat (List.map2 line lines (List.combine rows remarks))

(* The reader of a narrow table does not need the log's words, but the names of vehicles and tasks. *)
let lines ?(first = 1) ?heads ?columns ?before ?(remarks = []) ~source program run =
  let rows = rows ?before program ~source run in
  let is_row (t, _) = is_shown t in
  let of_rows texts = List.map snd (List.filter is_row (List.combine run texts)) in
  let heads =
    match heads with
    | Some heads -> of_rows heads
    | None ->
      let width = String.length (string_of_int (first + List.length rows)) in
      List.mapi (fun i _ -> Printf.sprintf "%*d" width (first + i)) rows
  in
  let remarks = of_rows (List.mapi (fun i _ -> List.assoc_opt i remarks) run) in
  let beside = if List.exists (fun row -> row.changed <> []) rows then In_column else Nowhere in
  match columns with
  | None -> table ~cut:false ~heads ~remarks ~widest ~words:None ~beside rows
  | Some columns ->
    let plain = List.map (fun row -> { row with assumed = [] }) rows and without = List.map (fun _ -> None) rows in
    let width ~beside widest =
      let beside = if beside = Below then Nowhere else beside in
      width_of_all (table ~heads ~remarks:without ~widest ~words:None ~beside plain) in
    let rec fitting ~least ~beside widest =
      if widest <= least || width ~beside widest <= columns then widest else fitting ~least ~beside (widest - 1) in
    let most = min columns (max widest (width_of_all (List.map (fun row -> row.text) rows))) in
    let beside =
      if beside = In_column && width ~beside (fitting ~least:readable ~beside most) > columns then Below else beside in
    let widest = fitting ~least:narrowest ~beside most in
    let has_words = List.exists (fun row -> row.words <> "") rows in
    let left = columns - width ~beside widest - 2 in
    if left < -2 then listing ~heads ~remarks ~columns rows
    else
      let words = if has_words && left >= least_words then Some left else None in
      table ~heads ~remarks ~widest ~words ~beside rows
