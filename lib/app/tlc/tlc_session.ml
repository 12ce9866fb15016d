open Dolphin_tlc

type model = (string * string) list

let unavailable why = Error (Error.Unavailable why)

let installation jar =
  match Installation.find ?jar Sys.getenv_opt with
  | Ok installation -> Ok installation
  | Error trouble -> unavailable (Format.asprintf "%a" Installation.pp_trouble trouble)

(* {1 Directories} *)

let write ~directory model =
  let file (name, text) : Text_file.file = { name; text; is_command = false } in
  match Text_file.write_all directory (List.map file model) with
  | Ok () -> Ok ()
  | Error error -> unavailable ("the model cannot be written: " ^ String.concat "; " (Error.sentences error))

let rec remove path =
  match Unix.lstat path with
  | { st_kind = S_DIR; _ } ->
    Array.iter (fun name -> remove (Filename.concat path name)) (Sys.readdir path);
    Unix.rmdir path
  | _ -> Unix.unlink path

(* A new private directory. *)
let temporary_directory () =
  let rec attempt n =
    let name = Printf.sprintf "dolphin-tlc-%d-%d" (Unix.getpid ()) n in
    let path = Filename.concat (Filename.get_temp_dir_name ()) name in
    match Unix.mkdir path 0o700 with
    | () -> path
    | exception Unix.Unix_error (EEXIST, _, _) when n < 1000 -> attempt (n + 1)
  in
  attempt 0

let in_directory directory model f =
  let written directory = Result.bind (write ~directory model) (fun () -> f directory) in
  match directory with
  | Some directory -> written directory
  | None -> (
      match temporary_directory () with
      | exception Unix.Unix_error (error, _, path) ->
        unavailable (Printf.sprintf "%s: %s" path (Unix.error_message error))
      | directory ->
        let clean () = try remove directory with Unix.Unix_error _ | Sys_error _ -> () in
        Fun.protect ~finally:clean (fun () -> written directory))

(* {1 Progress} *)

let clear () = Printf.eprintf "\r\027[K%!"
let show format = Printf.ksprintf (fun text -> Printf.eprintf "\r%s\027[K%!" text) format

let show_progress : Tlc_message.t -> unit = function
  | Version text -> show "%s: reads the model" text
  | Initial_states n -> show "searches from %s" (Dolphin_trace.Phrase.count n "initial state")
  | Progress { depth; generated; distinct; queue } ->
    show "searches: %d distinct states, %d generated, %d left, depth %d" distinct generated queue (depth - 1)
  | Checks_temporal states -> show "checks termination on %d states" states
  | Worker text -> show "%s" text
  | Begins _ | Violation _ | Behaviour | State _ | Stutters | Returns_to _ | Holds | Totals _ | Depth _ | Printed _
  | Assertion _ | Trouble _ | Warning _ | Other -> ()

(* {1 Running} *)

type ended = Ended of Outcome.t | Interrupted of Outcome.t

let because lines =
  match Outcome.java_too_old lines with
  | Some (needed, found) ->
    Printf.sprintf "TLC needs Java %d or later, and this is Java %d; JAVA_HOME may name another one" needed found
  | None -> "TLC failed: " ^ String.concat "\n" lines

let judge (ending : Process.ending) ~interrupted (outcome : Outcome.t) =
  match outcome.verdict, ending with
  | Failed lines, _ -> unavailable (because lines)
  | Gave_up why, _ -> Error (Error.Inconclusive ("TLC gave up: " ^ why))
  | (Holds | Violated _ | Unfinished), _ when interrupted -> Ok (Interrupted outcome)
  | (Holds | Violated _), _ -> Ok (Ended outcome)
  | Unfinished, Not_started why -> unavailable ("Java could not be started: " ^ why)
  | Unfinished, Exited 0 -> Ok (Ended outcome)
  | Unfinished, Exited status ->
    unavailable (Printf.sprintf "TLC ended with status %d before it was done" status)
  | Unfinished, Killed _ -> unavailable "TLC was killed before it was done"

let run installation mode ~directory ~main ~configuration printed =
  let interrupted = ref false in
  let ask_to_stop = Sys.Signal_handle (fun _ -> interrupted := true) in
  let former =
    List.map
      (fun signal -> (signal, Sys.signal signal ask_to_stop))
      (Sys.sighup :: Dolphin_processes.Ending_signals.requests @ Dolphin_processes.Ending_signals.others)
  in
  let live = Unix.isatty Unix.stderr in
  let reader = ref Message.start and outcome = ref Outcome.start in
  let take message =
    let event = Tlc_message.of_message message in
    if live then show_progress event;
    (match event with Printed text -> printed text | _ -> ());
    outcome := Outcome.event !outcome event
  in
  let line text =
    let next, messages = Message.line !reader text in
    reader := next;
    List.iter take messages
  in
  let directory = if Filename.is_relative directory then Filename.concat (Sys.getcwd ()) directory else directory in
  let ending =
    Process.run ~directory ~interrupted:(fun () -> !interrupted) line
      (Invocation.command installation mode ~directory ~main ~configuration)
  in
  List.iter take (Message.finish !reader);
  List.iter (fun (signal, behaviour) -> Sys.set_signal signal behaviour) former;
  if live then clear ();
  judge ending ~interrupted:!interrupted (Outcome.finish !outcome)
