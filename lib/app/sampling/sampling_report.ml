open Dolphin_semantics
module Safe_print = Dolphin_display.Safe_print
module Bounds = Dolphin_time.Bounds
module Distribution = Dolphin_statistics.Distribution
module Share = Dolphin_statistics.Share
module Histogram = Dolphin_display.Histogram
module Phrase = Dolphin_trace.Phrase
module Text_table = Dolphin_display.Text_table

(* {1 Texts} *)

let milliseconds seconds = Option.value (Bounds.milliseconds seconds) ~default:max_int
let time seconds = Format.asprintf "%a" Bounds.pp_time (milliseconds seconds)
let percent x = Printf.sprintf "%.2f %%" (100. *. x)

let kind : Sampled_run.ending -> string = function
  | Completed -> "completed"
  | Halted _ -> "halted"
  | Failed _ -> "failed"
  | Stuck _ -> "stuck"

let site : Sampled_run.ending -> Core.site option = function
  | Completed | Halted _ | Stuck None -> None
  | Failed fault -> Some fault.site
  | Stuck (Some site) -> Some site

let message : Sampled_run.ending -> string = function
  | Completed -> ""
  | Halted message -> message
  | Failed fault -> fault.message
  | Stuck None -> "nothing more can happen"
  | Stuck (Some _) -> "rounds follow each other, and none waits for anything"

let ending p (e : Sampled_run.ending) =
  let parts = [ kind e; Option.fold (site e) ~none:"" ~some:(Program_file.line p); message e ] in
  String.concat ": " (List.filter (( <> ) "") parts)

(* {1 For people} *)

(* Numbers stand to the right, all else to the left. *)
let table ~numbers heads rows =
  let is_number i = List.mem i numbers in
  let width i = List.fold_left (fun n row -> max n (Phrase.width (List.nth row i))) 0 (heads :: rows) in
  let widths = List.mapi (fun i _ -> width i) heads in
  let cell i text =
    if is_number i then String.make (List.nth widths i - Phrase.width text) ' ' ^ text else text in
  Text_table.lines (List.mapi cell heads) (List.map (List.mapi cell) rows)

let runs n = Phrase.count n "run"

let head (s : Sampling.t) =
  let seeds =
    match s.stop with
    | Interrupted _ -> ""
    | All | Known -> Printf.sprintf ", seeds %d to %d" s.settings.seed (s.settings.seed + s.runs - 1)
  in
  Printf.sprintf "%s%s, %.1f s" (runs s.runs) seeds s.seconds

let remark (s : Sampling.t) =
  match s.stop, s.settings.until with
  | All, None -> []
  | All, Some until -> [ Printf.sprintf "the share of those that complete is not known to within %g yet" until ]
  | Known, _ ->
    [ Printf.sprintf "the share of those that complete is known to within %g" (Option.get s.settings.until) ]
  | Interrupted [], _ -> [ "interrupted" ]
  | Interrupted seeds, _ ->
    let seeds = String.concat ", " (List.map string_of_int seeds) in
    [ Printf.sprintf "interrupted; under way were the runs with the seeds %s" seeds ]

(* Of many ways to end the rarest are not shown. *)
let most_endings = 12

let endings p (s : Sampling.t) =
  let row (e : Sampling.ending) =
    let { Share.least; most } = Sampling.share s e.runs in
    [ string_of_int e.runs; percent (Float.of_int e.runs /. Float.of_int s.runs);
      Printf.sprintf "%s to %s" (percent least) (percent most); string_of_int e.seed; ending p e.ending ]
  in
  let shown = List.filteri (fun i _ -> i < most_endings) s.endings in
  let hidden = List.length s.endings - List.length shown in
  let level = Printf.sprintf "%g %% confidence" (100. *. Sampling.level) in
  table ~numbers:[ 0; 1; 3 ] [ "runs"; "share"; level; "seed"; "end" ] (List.map row shown)
  @ if hidden > 0 then [ Printf.sprintf "and %s of ends that are rarer" (Phrase.count hidden "kind") ] else []

let most_bars = 16

let times ~columns (s : Sampling.t) =
  match s.first, s.last with
  | Some (first, first_seed), Some (last, last_seed) ->
    let quantile q = time (Distribution.quantile q s.completed) in
    let seed n = Printf.sprintf "seed %d" n in
    let heads = [ "completed"; "first"; "5 %"; "50 %"; "95 %"; "last" ] in
    let rows =
      [ [ ""; time first; quantile 0.05; quantile 0.5; quantile 0.95; time last ];
        [ ""; seed first_seed; ""; ""; ""; seed last_seed ] ]
    in
    let bar (b : Distribution.bin) = (Printf.sprintf "%s to %s" (time b.from) (time b.until), b.count) in
    ("" :: table ~numbers:[ 1; 2; 3; 4; 5 ] heads rows)
    @ "" :: Histogram.lines ~columns (List.map bar (Distribution.bins ~most:most_bars s.completed))
  | _, _ -> []

(* A column of zeros only is left out; so are the places of tasks, if they do not fit. *)
let tasks ~columns p (s : Sampling.t) =
  let number heading (f : Sampling.task -> int) = (heading, true, fun t -> string_of_int (f t)) in
  let text heading (f : Sampling.task -> string) = (heading, false, f) in
  let fields =
    [ text "task" (fun t -> t.task.name); text "vehicle" (fun t -> t.task.vehicle);
      number "began" (fun t -> t.counts.began); number "ended" (fun t -> t.counts.ended);
      number "failed" (fun t -> t.counts.failed); number "in runs" (fun t -> t.failing);
      number "stopped" (fun t -> t.counts.stopped) ]
  in
  let is_used (_, is_number, f) = not is_number || List.exists (fun t -> f t <> "0") s.tasks in
  let lines fields =
    let heads = List.map (fun (h, _, _) -> h) fields in
    let numbers = List.filter (fun i -> let _, n, _ = List.nth fields i in n) (List.mapi (fun i _ -> i) fields) in
    table ~numbers heads (List.map (fun t -> List.map (fun (_, _, f) -> f t) fields) s.tasks)
  in
  let narrow = List.filter is_used fields in
  let wide = lines (narrow @ [ text "where" (fun t -> Program_file.line p t.task.site) ]) in
  if s.tasks = [] then []
  else "" :: (if List.for_all (fun line -> Phrase.width line <= columns) wide then wide else lines narrow)

let handlers p (s : Sampling.t) =
  let row (h : Sampling.handler) = [ Program_file.line p h.site; string_of_int h.ran; string_of_int h.runs ] in
  if s.handlers = [] then []
  else "" :: table ~numbers:[ 1; 2 ] [ "handler"; "ran"; "in runs" ] (List.map row s.handlers)

let lines ~columns p (s : Sampling.t) =
  if s.runs = 0 then head s :: remark s
  else (head s :: remark s) @ endings p s @ times ~columns s @ tasks ~columns p s @ handlers p s

let print p s =
  let columns = Option.value (Run_columns.columns ()) ~default:80 in
  List.iter Safe_print.line (lines ~columns p s)

(* {1 For programs} *)

let seconds x : Yojson.Safe.t =
  let ms = milliseconds x in
  if ms mod 1000 = 0 then `Int (ms / 1000) else `Float (Float.of_int ms /. 1000.)

let rounded x : Yojson.Safe.t = `Float (Float.round (x *. 1e6) /. 1e6)
let place p site : Yojson.Safe.t = Option.fold ~none:`Null ~some:(fun at -> `String at) (Program_file.at p site)

let json_of_ending p s (e : Sampling.ending) : Yojson.Safe.t =
  let { Share.least; most } = Sampling.share s e.runs in
  `Assoc
    ([ ("end", `String (kind e.ending)); ("runs", `Int e.runs); ("least", rounded least); ("most", rounded most);
       ("seed", `Int e.seed) ]
     @ (match message e.ending with "" -> [] | why -> [ ("message", `String why) ])
     @ Option.fold (site e.ending) ~none:[] ~some:(fun site -> [ ("at", place p site) ]))

let json_of_times (s : Sampling.t) : Yojson.Safe.t =
  match s.first, s.last with
  | Some (first, first_seed), Some (last, last_seed) ->
    let with_seed x n = `Assoc [ ("seconds", seconds x); ("seed", `Int n) ] in
    let quantile q = seconds (Distribution.quantile q s.completed) in
    let bin (b : Distribution.bin) =
      `Assoc [ ("from", seconds b.from); ("until", seconds b.until); ("runs", `Int b.count) ] in
    `Assoc
      [ ("first", with_seed first first_seed); ("5%", quantile 0.05); ("50%", quantile 0.5); ("95%", quantile 0.95);
        ("last", with_seed last last_seed);
        ("histogram", `List (List.map bin (Distribution.bins ~most:most_bars s.completed))) ]
  | _, _ -> `Null

let json_of_task p (t : Sampling.task) : Yojson.Safe.t =
  `Assoc
    [ ("task", `String t.task.name); ("vehicle", `String t.task.vehicle); ("at", place p t.task.site);
      ("began", `Int t.counts.began); ("ended", `Int t.counts.ended); ("failed", `Int t.counts.failed);
      ("runs failed", `Int t.failing); ("stopped", `Int t.counts.stopped) ]

let json_of_handler p (h : Sampling.handler) : Yojson.Safe.t =
  `Assoc [ ("at", place p h.site); ("ran", `Int h.ran); ("runs", `Int h.runs) ]

let to_json p (s : Sampling.t) : Yojson.Safe.t =
  let stop =
    match s.stop with
    | All -> [ ("stopped by", `String "runs") ]
    | Known -> [ ("stopped by", `String "until") ]
    | Interrupted seeds ->
      [ ("stopped by", `String "interruption"); ("under way", `List (List.map (fun n -> `Int n) seeds)) ]
  in
  `Assoc
    ([ ("runs", `Int s.runs); ("seed", `Int s.settings.seed); ("confidence", `Float Sampling.level) ]
     @ stop
     @ [ ("ends", `List (List.map (json_of_ending p s) s.endings)); ("completed", json_of_times s);
         ("tasks", `List (List.map (json_of_task p) s.tasks));
         ("handlers", `List (List.map (json_of_handler p) s.handlers)); ("elapsed", `Float s.seconds) ])
