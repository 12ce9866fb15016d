open Dolphin_app

let search ~json ?period f =
  let live = Unix.isatty Unix.stderr && not json && period = None in
  let interrupted = ref false in
  Sys.set_signal Sys.sigint (Signal_handle (fun _ -> interrupted := true));
  let progress =
    match period with
    | Some seconds -> Progress_lines.every seconds prerr_endline
    | None when live -> fun p -> Printf.eprintf "\r%s\027[K%!" (Progress_lines.line p)
    | None -> if json then ignore else Progress_lines.every 10. prerr_endline
  in
  let found = f ~interrupted:(fun () -> !interrupted) ~progress in
  if live then Printf.eprintf "\r\027[K%!";
  found
