open Dolphin_app

let search ~json ?period f =
  let live = Unix.isatty Unix.stderr && not json && period = None in
  let interrupted = ref false in
  (* A second signal ends the process, and so does one that comes when the result is printed. *)
  let interrupt _ =
    interrupted := true;
    Sys.set_signal Sys.sigint Signal_default
  in
  Sys.set_signal Sys.sigint (Signal_handle interrupt);
  let progress =
    match period with
    | Some seconds -> Progress_lines.every seconds prerr_endline
    | None when live -> fun p -> Printf.eprintf "\r%s\027[K%!" (Progress_lines.line p)
    | None -> if json then ignore else Progress_lines.every 10. prerr_endline
  in
  let found = f ~interrupted:(fun () -> !interrupted) ~progress in
  Sys.set_signal Sys.sigint Signal_default;
  if live then Printf.eprintf "\r\027[K%!";
  found
