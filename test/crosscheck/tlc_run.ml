open Dolphin_tlc

let outcome ?(line = ignore) installation ~main ~configuration files =
  let reader = ref Message.start and outcome = ref Outcome.start in
  let take message =
    let event = Tlc_message.of_message message in
    outcome := Outcome.event !outcome event;
    match event with Printed text -> line text | _ -> ()
  in
  let read text =
    let next, messages = Message.line !reader text in
    reader := next;
    List.iter take messages
  in
  let run directory =
    let command =
      Invocation.command ~short:true installation (Local (Workers 1)) ~directory ~main ~configuration in
    ignore (Process.run ~directory ~interrupted:(fun () -> false) read command : Process.ending);
    List.iter take (Message.finish !reader)
  in
  Batch.in_directory files run;
  Outcome.finish !outcome

let last_state steps = match List.rev steps with (s : Outcome.step) :: _ -> s.state | [] -> "the initial state"

let judge (o : Outcome.t) =
  match o.verdict with
  | Holds -> Ok ()
  | Violated { violation = Invariant name | Property name; steps; _ } ->
    Error (Printf.sprintf "%s does not hold:\n%s" name (last_state steps))
  | Violated { violation = Temporal | Deadlock | Unnamed; steps; _ } -> Error (last_state steps)
  | Unfinished -> Error "TLC did not come to its end"
  | Gave_up why -> Error why
  | Failed lines -> Error (String.concat "\n" lines)
