open Dolphin_semantics
module Safe_print = Dolphin_display.Safe_print
module Witness = Dolphin_trace.Witness
module Log = Dolphin_display.Log
module Scenario_world = Dolphin_environment.Scenario_world

(* The columns of the time, which these runs lack. *)
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
    List.iter (fun (line : Log.line) -> Safe_print.line (without_time number line.text)) lines;
    List.iter (fun a -> Safe_print.line (Format.asprintf "      if %a" World.pp_assumption a)) t.assumed;
    (number + 1, log)
  in
  List.fold_left print (first, log) transitions

let ending transitions =
  match List.rev transitions with
  | ({ next = { control = Ended ending; _ }; _ } : Transition.t) :: _ -> Some ending
  | _ -> Safe_print.line "      here the recorded run stops"; None

let draw program fleet (witness : Witness.t) steps cycle drawing =
  let description = if witness.property = "" then "as recorded" else witness.property in
  Witness_file.draw program fleet drawing { breaks = witness.property; description; steps; cycle }

let follow (program : Program_file.t) (fleet : Fleet_file.t) ~drawing path witness =
  match Witness.follow program.program (Scenario_world.world fleet.scenario) witness with
  | Error (taken, { number; why }) ->
    ignore (print_log 1 Log.start taken);
    Error (Error.Bad_input (Printf.sprintf "%s: %s does not fit, at step %d: %s" path program.path number why))
  | Ok (steps, cycle) ->
    if witness.property <> "" then Safe_print.printf "breaks: %s\n" (Dolphin_trace.Phrase.one_line witness.property);
    let number, log = print_log 1 Log.start steps in
    let ending =
      if cycle = [] then ending steps
      else begin
        Safe_print.line "and from there, again and again:";
        ignore (print_log number log cycle);
        None
      end
    in
    let drawn = Option.fold drawing ~none:(Ok ()) ~some:(draw program fleet witness steps cycle) in
    Result.map (fun () -> ending) drawn

let print program fleet ~drawing path = Result.bind (Witness_file.read path) (follow program fleet ~drawing path)
