open Dolphin_tlc

let outcome installation ~main ~configuration files =
  let reader = ref Message.start and outcome = ref Outcome.start in
  let take message = outcome := Outcome.event !outcome (Event.of_message message) in
  let line text =
    let next, messages = Message.line !reader text in
    reader := next;
    List.iter take messages
  in
  let run directory =
    let command =
      Invocation.command ~short:true installation (Local (Workers 1)) ~directory ~main ~configuration in
    ignore (Process.run ~directory ~interrupted:(fun () -> false) line command : Process.ending);
    List.iter take (Message.finish !reader)
  in
  Batch.in_directory files run;
  Outcome.finish !outcome
