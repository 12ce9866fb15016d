module Columns = Dolphin_display.Columns
module Waiting = Dolphin_display.Waiting
open Dolphin_semantics
module Safe_print = Dolphin_display.Safe_print

(* A terminal's own width; for other outputs, the user's. *)
let columns () =
  if Unix.isatty Unix.stdout then Some (snd (Dolphin_display.Terminal.size Unix.stdout))
  else Option.bind (Sys.getenv_opt "COLUMNS") int_of_string_opt

let say text =
  match columns () with
  | Some columns -> List.iter Safe_print.line (Dolphin_display.Paragraph.hanging ~columns text)
  | None -> Safe_print.line text

let last steps cycle = match List.rev (steps @ cycle) with [] -> None | (t : Transition.t) :: _ -> Some t.next

let tuples steps cycle =
  match last steps cycle with
  | Some c when not (Tuples.is_empty c.shared.tuples) -> [ Format.asprintf "tuples then: %a" Tuples.pp c.shared.tuples ]
  | Some _ | None -> []

let decides = "decides the formula: the rest of the run does not matter"

let lines ?columns ?decided (p : Program_file.t) ~steps ~cycle =
  let lines ~first ~before ~remarks = Columns.lines ~first ?columns ?before ~remarks ~source:p.source p.program in
  let around =
    if cycle = [] then []
    else
      "and from there, again and again:"
      :: lines ~first:(List.length steps + 1) ~before:(last steps []) ~remarks:[] cycle
  in
  let remarks = Option.fold decided ~none:[] ~some:(fun n -> [ (n - 1, decides) ]) in
  lines ~first:1 ~before:None ~remarks steps @ around @ tuples steps cycle

let print ?decided p ~steps ~cycle = List.iter Safe_print.line (lines ?columns:(columns ()) ?decided p ~steps ~cycle)
let text ?decided p ~steps ~cycle = String.concat "\n" (lines ?decided p ~steps ~cycle)

let print_waiting (p : Program_file.t) steps =
  let guard (w : Waiting.t) =
    let place = Fmt.(option (any " at " ++ Dolphin_syntax.Location.pp)) in
    let lacking = Fmt.(option (any ": " ++ string)) in
    Format.asprintf "waits for the condition%a, %s%a" place w.at w.what lacking w.lacking
  in
  let add found line = if List.mem line found then found else line :: found in
  match last steps [] with
  | Some ({ control = Executing _; _ } as c) ->
    let all = List.map guard (Waiting.list p.program ~source:p.source (World.at Any World.empty) c) in
    List.iter Safe_print.line (List.rev (List.fold_left add [] all))
  | Some _ | None -> ()
