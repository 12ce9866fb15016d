open Dolphin_semantics

type row = { name : string; covers : string list; taken : string list }
type t = row list  (* latest first *)

let empty = []

let add ~name ~covers ~taken rows =
  { name; covers = List.filter (fun rule -> List.mem rule taken) covers; taken } :: rows

let rules = List.map Rule.name Rule.all
let about rule rows = List.filter (fun row -> List.mem rule row.covers) (List.rev rows)
let untaken rows = List.filter (fun rule -> about rule rows = []) rules

let pp ppf rows =
  let width = List.fold_left (fun n rule -> max n (String.length rule)) 0 rules in
  let line ppf rule =
    let taking = List.length (List.filter (fun row -> List.mem rule row.taken) rows) in
    let names =
      match about rule rows with [] -> "none" | rows -> String.concat ", " (List.map (fun row -> row.name) rows) in
    Format.fprintf ppf "%-*s %4d  %s" width rule taking names
  in
  Format.fprintf ppf "@[<v>%a@]" (Format.pp_print_list line) rules
