open Dolphin_semantics
module Witness = Dolphin_trace.Witness
module Log = Dolphin_display.Log
module Scenario_world = Dolphin_environment.Scenario_world

(* The columns of the time, which there is none of. *)
let time_columns = 9

let without_time number text =
  let cut i line =
    let head = if i = 0 then Printf.sprintf "%4d" number else "    " in
    head ^ "  " ^ String.sub line time_columns (String.length line - time_columns)
  in
  String.concat "\n" (List.mapi cut (String.split_on_char '\n' text))

let print_log first log transitions =
  let print (number, log) (t : Transition.t) =
    let log, lines = Log.transition log ~time:0. t in
    List.iter (fun line -> print_endline (without_time number line)) lines;
    List.iter (fun a -> print_endline (Format.asprintf "      if %a" World.pp_assumption a)) t.assumed;
    (number + 1, log)
  in
  List.fold_left print (first, log) transitions

let ending (program : Program_file.t) transitions : Exit_status.t =
  let last = List.fold_left (fun _ (t : Transition.t) -> Some t.next.control) None transitions in
  match last with
  | Some (Ended (Failed fault)) ->
    let at = Option.value (Fault.location program.program fault) ~default:Dolphin_syntax.Location.none in
    Report.diagnostics ~source:program.source [ Dolphin_syntax.Diagnostic.error at fault.message ];
    Failed
  | Some (Ended (Halted _)) -> Failed
  | Some (Ended Interrupted) -> Interrupted
  | Some (Ended Completed) -> Done
  | None | Some (Script _ | Waiting _ | Executing _) -> print_endline "      here the recorded run stops"; Done

let run (program : Program_file.t) scenario path : Exit_status.t =
  let refuse why = Report.complain (Printf.sprintf "%s: %s" path why); Exit_status.Bad_input in
  match Text_file.read path with
  | Error why -> Report.complain why; Bad_input
  | Ok text -> (
      let lines = List.filter (fun line -> line <> "") (String.split_on_char '\n' text) in
      match Witness.of_lines lines with
      | Error why -> refuse why
      | Ok witness -> (
          match Witness.follow program.program (Scenario_world.world scenario) witness with
          | Error (taken, misfit) ->
            ignore (print_log 1 Log.start taken);
            refuse (Printf.sprintf "%s does not fit, at step %d: %s" program.path misfit.number misfit.why)
          | Ok (steps, cycle) ->
            Printf.printf "breaks: %s\n" witness.property;
            let number, log = print_log 1 Log.start steps in
            if cycle = [] then ending program steps
            else begin
              print_endline "and from there, again and again:";
              ignore (print_log number log cycle);
              Done
            end))
