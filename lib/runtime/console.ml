open Lwt.Infix

type t = {
  say : string -> unit;
  ask : string -> (string, string) result Lwt.t;
  refused : string -> unit;
}

let longest_answer = 65_536

let show text =
  print_string text;
  flush stdout

(* The text that the person typed; a line that was begun on the screen is ended here if necessary. *)
let typed lines output =
  Lwt.catch
    (fun () -> Lines.next lines)
    (fun error ->
       output "\n";
       Lwt.fail error)
  >|= function
  | Lines.Line text -> Ok text
  | Too_long -> Error (Printf.sprintf "the answer is longer than %d bytes" longest_answer)
  | End_of_input ->
    output "\n";
    Error "end of input"

let scripted ?(input = Lwt_unix.stdin) ?(output = show) ~answers () =
  let remaining = ref answers in
  let lines = Lines.make ~limit:longest_answer input in
  let ask prompt =
    match !remaining with
    | answer :: others ->
      remaining := others;
      output (Printf.sprintf "%s %s\n" prompt answer);
      Lwt.return (Ok answer)
    | [] ->
      output (prompt ^ " ");
      typed lines output
  in
  { say = (fun text -> output (text ^ "\n"));
    ask;
    refused = (fun why -> output (Printf.sprintf "This answer cannot be taken: %s\n" why)) }
