module Safe_print = Dolphin_display.Safe_print

module Search = Dolphin_explore.Search
module Property = Dolphin_explore.Property

let violated ~strict (o : Search.outcome) =
  let name (property, (verdict : Search.verdict)) =
    match verdict with
    | (Violated _ | Unreached _) when strict || not (Exploration.is_remark property) -> Some (Property.name property)
    | Violated _ | Unreached _ | Holds | Holds_if _ | By_design _ | Inconclusive _ -> None
  in
  List.filter_map name o.verdicts

let cells ~strict ({ found; verdict; _ } : Search.outcome Sweep.row) =
  let words =
    match verdict with
    | Holds when Search.needs found <> [] -> Format.asprintf "holds %a" Search.pp_needs (Search.needs found)
    | Holds -> "holds"
    | Violated -> "violated: " ^ String.concat ", " (violated ~strict found)
    | Inconclusive -> "inconclusive"
  in
  [ string_of_int found.states; words ]

let print_run ~strict s (row : Search.outcome Sweep.row) =
  Safe_print.printf "\n%s:" (Sweep.name s row);
  Exploration_report.print_violations ~strict row.program row.found

let print ~strict s rows =
  Sweep.print s ~heads:[ "states"; "verdict" ] (cells ~strict) rows;
  match Sweep.fewest rows, List.rev rows with
  | Some { below = Some ({ verdict = Violated; _ } as row); _ }, _ | None, ({ verdict = Violated; _ } as row) :: _ ->
    print_run ~strict s row
  | Some _, _ | None, _ -> ()

let to_json s rows =
  Sweep.to_json s
    (fun (row : Search.outcome Sweep.row) -> Exploration_report.to_json row.program row.found) rows
