open Dolphin_app
module Diagnostic = Dolphin_syntax.Diagnostic

(* An error may quote names and texts from anywhere: a terminal gets no control characters from it. *)
let complain sentence = Format.eprintf "dolphin: %s@." (Dolphin_trace.Phrase.harmless sentence)

(* Cmdliner quotes arguments as they were typed. *)
let of_arguments =
  let text = Buffer.create 200 in
  let show () =
    prerr_string (Dolphin_trace.Phrase.harmless (Buffer.contents text));
    flush stderr;
    Buffer.clear text
  in
  Format.make_formatter (Buffer.add_substring text) show

let diagnostics ~source found =
  if found <> [] then Format.eprintf "%a@." Error.pp (Error.Bad_text { source; found })

let tell e =
  match Error.sentences e with
  | [] -> Format.eprintf "%a@." Error.pp e
  | sentences -> List.iter complain sentences

let error (e : Error.t) : Exit_status.t =
  tell e;
  match e with
  | Bad_input _ | Bad_text _ | Incompatible _ -> Bad_input
  | Unavailable _ -> Platform_trouble
  | Interrupted _ -> Interrupted
  | Inconclusive _ | Unsettled _ -> Inconclusive

let result = function Ok status -> status | Error e -> error e

let counts ds =
  let is_error (d : Diagnostic.t) = match d.severity with Error -> true | Warning -> false in
  let errors, warnings = List.partition is_error ds in
  let first = if errors = [] then "no errors" else Dolphin_trace.Phrase.count (List.length errors) "error" in
  if warnings = [] then first else first ^ ", " ^ Dolphin_trace.Phrase.count (List.length warnings) "warning"
