module Columns = Dolphin_display.Columns
module Waiting = Dolphin_display.Waiting
open Dolphin_semantics

(* Of a terminal its own; of anything else what the user says. *)
let columns () =
  if Unix.isatty Unix.stdout then Some (snd (Dolphin_display.Terminal.size Unix.stdout))
  else Option.bind (Sys.getenv_opt "COLUMNS") int_of_string_opt

let last steps cycle = match List.rev (steps @ cycle) with [] -> None | (t : Transition.t) :: _ -> Some t.next

let print_tuples steps cycle =
  match last steps cycle with
  | Some c when not (Tuples.is_empty c.shared.tuples) -> Format.printf "tuples then: %a@." Tuples.pp c.shared.tuples
  | Some _ | None -> ()

let print (p : Program_file.t) ~steps ~cycle =
  let lines ~first = Columns.lines ~first ?columns:(columns ()) ~source:p.source p.program in
  let print = List.iter print_endline in
  print (lines ~first:1 steps);
  if cycle <> [] then begin
    print_endline "and from there, again and again:";
    print (lines ~first:(List.length steps + 1) cycle)
  end;
  print_tuples steps cycle

let print_waiting (p : Program_file.t) steps =
  let guard (w : Waiting.t) =
    let place = Fmt.(option (any " at " ++ Dolphin_syntax.Location.pp)) in
    let lacking = Fmt.(option (any ": " ++ string)) in
    Format.printf "waits for the condition%a, %s%a@." place w.at w.what lacking w.lacking
  in
  match last steps [] with
  | Some ({ control = Executing _; _ } as c) ->
    List.iter guard (Waiting.list p.program ~source:p.source World.empty c)
  | Some _ | None -> ()
