open Dolphin_semantics
module Columns = Dolphin_display.Columns
module Waiting = Dolphin_display.Waiting
module Phrase = Dolphin_trace.Phrase
module Location = Dolphin_syntax.Location

type t = { program : Program_file.t; columns : int }

(* {1 Lines} *)

let wrapped = Dolphin_display.Paragraph.lines
let item v name text = wrapped ~columns:v.columns ~head:(Phrase.pad 10 name) text
let item_unless_empty v name text = if text = "" then [] else item v name text
let listed = function [] -> "-" | items -> String.concat ", " items

(* {1 States} *)

let place at = Printf.sprintf "%s:%d" (Filename.basename (Location.file at)) (Location.line at)

let of_waiting (w : Waiting.t) =
  let at = match w.at with Some at -> place at ^ ": " | None -> "" in
  at ^ w.what ^ match w.lacking with Some lacking -> "; " ^ lacking | None -> ""

let of_ending : Configuration.ending -> string = function
  | Completed -> "the program has ended"
  | Halted "" -> "the program has halted"
  | Halted message -> "the program has halted: " ^ message
  | Failed fault -> "the program has failed: " ^ fault.message
  | Interrupted -> "the program was interrupted"

let of_control v (c : Configuration.t) =
  let at = Option.fold ~none:"" ~some:place (Fault.location v.program.program (Fault.make (Configuration.site c) "")) in
  match c.control with
  | Script _ -> item v "script" at
  | Waiting _ -> []
  | Executing (_, r) -> item v "task" (Format.asprintf "%a" Residual.pp r)
  | Ended ending -> item v "end" (of_ending ending)

(* The vehicles in reach at a pick are not known before its choice. *)
let waiting v (c : Configuration.t) =
  let all = Waiting.list v.program.program ~source:v.program.source (World.at Any World.empty) c in
  match c.control with
  | Waiting (_, Pick _) -> List.map (fun w -> { w with Waiting.lacking = None }) all
  | Waiting _ | Script _ | Executing _ | Ended _ -> all

let state v r =
  let c = Manual_run.configuration r in
  let running (u, (p : Core.platform_task)) = Printf.sprintf "%s -> %s" u p.name in
  let tuples = Tuples.bindings c.shared.tuples in
  let pairs (k, xs) = List.map (fun x -> Format.asprintf "%a" Value.pp_tuple (k, x)) xs in
  let waits = waiting v c in
  List.concat
    [ item v "A" (listed (List.map running (Vehicle_map.bindings c.shared.allocation)));
      item v "B" (listed c.shared.bound);
      item v "N" (listed (List.concat_map pairs tuples));
      of_control v c;
      List.concat_map (fun w -> item v "waits for" (of_waiting w)) waits;
      item_unless_empty v "lost" (String.concat ", " (Dolphin_environment.Environment.lost (Manual_run.outside r))) ]

let variables v r =
  let named (i, x) =
    item v v.program.program.global_names.(i) (Format.asprintf "%a" Value.pp x) in
  match Store.bindings (Manual_run.configuration r).shared.store with
  | [] -> [ "no variable has a value" ]
  | all -> List.concat_map named all

(* {1 Steps} *)

let choice v n ~is_next r ((t : Transition.t), _) =
  let row = Columns.row v.program.program ~source:v.program.source (Some (Manual_run.configuration r)) t in
  let head = Printf.sprintf "%s%3d  " (if is_next then ">" else " ") n in
  let place = match Columns.place row with "" -> "" | place -> " (" ^ place ^ ")" in
  let text = if row.words = "" then row.text else row.words in
  let assumed a = wrapped ~columns:v.columns ~head:"       if " (Format.asprintf "%a" World.pp_assumption a) in
  wrapped ~columns:v.columns ~head (row.actor ^ " " ^ text ^ place)
  @ List.concat_map assumed row.assumed

let run v r =
  match Manual_run.steps r with
  | [] -> [ "no step was taken" ]
  | steps -> Columns.lines ~columns:v.columns ~source:v.program.source v.program.program steps
