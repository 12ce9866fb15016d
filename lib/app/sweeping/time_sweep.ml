module Timed_analysis = Dolphin_time.Timed_analysis
module Safe_print = Dolphin_display.Safe_print

let verdict ?deadline o : Sweep.verdict =
  match Timed_analysis.shortfall ?deadline o with None -> Holds | Some Unknown -> Inconclusive | Some _ -> Violated

let shortfall : Timed_analysis.shortfall -> string = function
  | Never_ends -> "does not end"
  | Fails -> "fails"
  | Late -> "late"
  | Misses -> "within missed"
  | Empty -> "battery empty"
  | Too_near -> "plans too near"
  | Unknown -> "inconclusive"

let earliest (o : Timed_analysis.outcome) =
  List.fold_left (fun found (_, (w : Timed_analysis.window)) -> min found w.earliest) max_int o.endings

let cells ?deadline ({ found = o; _ } : Timed_analysis.outcome Sweep.row) =
  let first = if o.endings = [] then "" else Time_report.time (earliest o) in
  let last =
    match Timed_analysis.latest o with
    | Some (At n) when o.endless = None -> Time_report.time n
    | Some (At _) | Some Unbounded -> "unbounded"
    | None -> ""
  in
  [ first; last; string_of_int o.states;
    Option.fold (Timed_analysis.shortfall ?deadline o) ~none:"holds" ~some:shortfall ]

let print_run ?deadline s ({ program; found; verdict; _ } as row : Timed_analysis.outcome Sweep.row) =
  if verdict <> Inconclusive then begin
    Safe_print.printf "\n%s:" (Sweep.name s row);
    match Timed_analysis.shortfall ?deadline found, found.failing with
    | Some Fails, Some run -> Time_report.print_failing program run
    | _, _ -> Time_report.print_run ?deadline program found
  end

let print ?deadline s rows =
  Sweep.print s ~heads:[ "earliest"; "latest"; "states"; "verdict" ] (cells ?deadline) rows;
  match Sweep.fewest rows, List.rev rows with
  | Some { row; below; _ }, _ ->
    Option.iter (print_run ?deadline s) below;
    print_run ?deadline s row
  | None, last :: _ -> print_run ?deadline s last
  | None, [] -> ()

let to_json ?deadline s rows =
  let found (row : Timed_analysis.outcome Sweep.row) = Time_report.to_json ?deadline row.program row.found in
  Sweep.to_json s found rows
