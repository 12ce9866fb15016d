let patience = 15

let fork ?(patience = patience) f =
  flush_all ();
  match Lwt_unix.fork () with
  | 0 ->
    ignore (Unix.alarm patience);
    let code =
      match f () with
      | code -> code
      | exception error -> prerr_endline (Printexc.to_string error); 125
    in
    Unix._exit code
  | pid -> pid

let rec wait pid =
  match Unix.waitpid [] pid with
  | _, status -> status
  | exception Unix.Unix_error (EINTR, _, _) -> wait pid

let stop pid =
  Unix.kill pid Sys.sigkill;
  ignore (wait pid)
