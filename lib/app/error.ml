open Dolphin_syntax

type t =
  | Bad_input of string
  | Bad_text of { source : string; found : Diagnostic.t list }
  | Incompatible of { path : string; differences : string list }
  | Unavailable of string
  | Interrupted of string
  | Inconclusive of string
  | Unsettled of { source : string; fault : Diagnostic.t }

let diagnostics = function
  | Bad_text { found; _ } -> found
  | Unsettled { fault; _ } -> [ fault ]
  | Bad_input _ | Incompatible _ | Unavailable _ | Interrupted _ | Inconclusive _ -> []

let sentences = function
  | Bad_input why | Unavailable why | Interrupted why | Inconclusive why -> [ why ]
  | Incompatible { path; differences } ->
    List.map (Printf.sprintf "%s is not the IMC that Dolphin speaks: %s" path) differences
  | Bad_text _ | Unsettled _ -> []

let pp_diagnostics ~source ppf found =
  Format.pp_print_list ~pp_sep:Format.pp_force_newline (Diagnostic.pp ~source) ppf
    (List.stable_sort Diagnostic.compare found)

let pp ppf e =
  match e with
  | Bad_input _ | Incompatible _ | Unavailable _ | Interrupted _ | Inconclusive _ ->
    Format.pp_print_list ~pp_sep:Format.pp_force_newline Format.pp_print_string ppf (sentences e)
  | Bad_text { source; found } -> pp_diagnostics ~source ppf found
  | Unsettled { source; fault } -> pp_diagnostics ~source ppf [ fault ]
