module Columns = Dolphin_display.Columns
module Waiting = Dolphin_display.Waiting
open Dolphin_semantics

(* A terminal's own width; for other outputs, the user's. *)
let columns () =
  if Unix.isatty Unix.stdout then Some (snd (Dolphin_display.Terminal.size Unix.stdout))
  else Option.bind (Sys.getenv_opt "COLUMNS") int_of_string_opt

let say text =
  match columns () with
  | Some columns -> List.iter print_endline (Dolphin_display.Paragraph.hanging ~columns text)
  | None -> print_endline text

let last steps cycle = match List.rev (steps @ cycle) with [] -> None | (t : Transition.t) :: _ -> Some t.next

let tuples steps cycle =
  match last steps cycle with
  | Some c when not (Tuples.is_empty c.shared.tuples) -> [ Format.asprintf "tuples then: %a" Tuples.pp c.shared.tuples ]
  | Some _ | None -> []

let lines ?columns (p : Program_file.t) ~steps ~cycle =
  let lines ~first = Columns.lines ~first ?columns ~source:p.source p.program in
  let around =
    if cycle = [] then []
    else "and from there, again and again:" :: lines ~first:(List.length steps + 1) cycle
  in
  lines ~first:1 steps @ around @ tuples steps cycle

let print p ~steps ~cycle = List.iter print_endline (lines ?columns:(columns ()) p ~steps ~cycle)
let text p ~steps ~cycle = String.concat "\n" (lines p ~steps ~cycle)

let print_waiting (p : Program_file.t) steps =
  let guard (w : Waiting.t) =
    let place = Fmt.(option (any " at " ++ Dolphin_syntax.Location.pp)) in
    let lacking = Fmt.(option (any ": " ++ string)) in
    Format.printf "waits for the condition%a, %s%a@." place w.at w.what lacking w.lacking
  in
  match last steps [] with
  | Some ({ control = Executing _; _ } as c) ->
    List.iter guard (Waiting.list p.program ~source:p.source (World.at Any World.empty) c)
  | Some _ | None -> ()
