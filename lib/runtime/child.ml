open Lwt.Infix

type t = {
  pid : int;
  input : Lwt_unix.file_descr;
  output : Lwt_unix.file_descr;
  exited : Unix.process_status Lwt.t;
  mutable closing : unit Lwt.t option;
}

let input c = c.input
let output c = c.output
let exited c = Lwt.protected c.exited

(* The child's whole process group; the child alone if it has not made the group yet. *)
let signal pid number =
  try Unix.kill (-pid) number with Unix.Unix_error _ -> ( try Unix.kill pid number with Unix.Unix_error _ -> ())

let kill_group pid = try Unix.kill (-pid) Sys.sigkill with Unix.Unix_error _ -> ()

let with_environment added =
  (* The parts of a split text are never empty. *)
  let name binding = List.hd (String.split_on_char '=' binding) in
  let kept = List.filter (fun b -> not (List.mem_assoc (name b) added)) (Array.to_list (Unix.environment ())) in
  Array.of_list (kept @ List.map (fun (name, x) -> name ^ "=" ^ x) added)

(* In the child: never returns. *)
let become command environment standard_input standard_output standard_error =
  (try
     ignore (Unix.setsid ());
     List.iter (fun signal -> Sys.set_signal signal Sys.Signal_default) [ Sys.sigpipe; Sys.sigxfsz ];
     Unix.dup2 ~cloexec:false standard_input Unix.stdin;
     Unix.dup2 ~cloexec:false standard_output Unix.stdout;
     Unix.dup2 ~cloexec:false standard_error Unix.stderr;
     Unix.execve "/bin/sh" [| "/bin/sh"; "-c"; command |] environment
   with _ ->
     (* Whatever it is: an exception would go on as a second copy of the console. *)
     ());
  Unix._exit 127

(* The time for the last errors of a child that has ended. *)
let last_errors = 0.5

let reaped pid ~errors =
  Lwt_unix.waitpid [] pid >>= fun (_, status) ->
  kill_group pid;
  Lwt.pick [ Lwt.protected errors; Lwt_unix.sleep last_errors ] >|= fun () -> status

let start ~environment command =
  Sys.set_signal Sys.sigpipe Sys.Signal_ignore;
  let environment = with_environment environment in
  try
    let standard_input, input = Lwt_unix.pipe_out ~cloexec:true () in
    let output, standard_output = Lwt_unix.pipe_in ~cloexec:true () in
    let errors, standard_error = Lwt_unix.pipe_in ~cloexec:true () in
    match Unix.fork () with
    | 0 -> become command environment standard_input standard_output standard_error
    | pid ->
      Unix.close standard_input;
      Unix.close standard_output;
      Unix.close standard_error;
      Ok { pid; input; output; exited = reaped pid ~errors:(Error_stream.pass_on errors); closing = None }
  with Unix.Unix_error (error, _, _) -> Error (Unix.error_message error)

let name_of_signal number =
  let names =
    [ (Sys.sigabrt, "SIGABRT"); (Sys.sigbus, "SIGBUS"); (Sys.sigfpe, "SIGFPE"); (Sys.sighup, "SIGHUP");
      (Sys.sigill, "SIGILL"); (Sys.sigint, "SIGINT"); (Sys.sigkill, "SIGKILL"); (Sys.sigpipe, "SIGPIPE");
      (Sys.sigquit, "SIGQUIT"); (Sys.sigsegv, "SIGSEGV"); (Sys.sigterm, "SIGTERM") ]
  in
  match List.assoc_opt number names with Some name -> name | None -> Printf.sprintf "signal %d" number

let pp_status ppf : Unix.process_status -> unit = function
  | WEXITED code -> Format.fprintf ppf "ended with exit status %d" code
  | WSIGNALED number -> Format.fprintf ppf "was killed by %s" (name_of_signal number)
  | WSTOPPED number -> Format.fprintf ppf "was stopped by %s" (name_of_signal number)

let close_descriptor descriptor =
  Lwt.catch (fun () -> Lwt_unix.close descriptor) (fun _ -> Lwt.return_unit)

(* Whether the child ends within this number of seconds. *)
let ends_within c seconds =
  Lwt.pick [ (exited c >|= fun _ -> true); (Lwt_unix.sleep seconds >|= fun () -> false) ]

let rec insist c = function
  | [] -> Lwt.return_unit
  | (number, seconds) :: others ->
    signal c.pid number;
    ends_within c seconds >>= fun ended -> if ended then Lwt.return_unit else insist c others

let finish c =
  close_descriptor c.input >>= fun () ->
  ends_within c 0.5 >>= fun ended ->
  (if ended then Lwt.return_unit else insist c [ (Sys.sigterm, 1.); (Sys.sigkill, 5.) ]) >>= fun () ->
  close_descriptor c.output

let close c =
  match c.closing with
  | Some closing -> closing
  | None ->
    let closing = Lwt.no_cancel (finish c) in
    c.closing <- Some closing;
    closing

let kill c =
  kill_group c.pid;
  signal c.pid Sys.sigkill;
  close c
