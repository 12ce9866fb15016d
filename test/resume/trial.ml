open Dolphin_trace

type t = { death : Console.death; again : Console.death; pause : float; lost : int }

let pp ppf t =
  let death ppf : Console.death -> unit = function
    | Before i -> Format.fprintf ppf "before line %d" i
    | Within i -> Format.fprintf ppf "within line %d" i
    | After i -> Format.fprintf ppf "after line %d" i
    | Never -> Format.fprintf ppf "never"
  in
  Format.fprintf ppf "killed %a, %g s later resumed" death t.death t.pause;
  if t.lost > 0 then Format.fprintf ppf ", without the last %d notes of requests" t.lost;
  if t.again <> Never then Format.fprintf ppf ", killed %a" death t.again

let ports_of_one = 16

(* Trials that run at once have numbers that are near each other. *)
let port ~ports number = ports + (number mod (Test_support.Ports.count / ports_of_one) * ports_of_one)

(* {1 What must be so afterwards} *)

let check_journal ~is_whole path =
  let channel = open_in_bin path in
  let verdict = snd (Journal_verdict.check Console.program ~hash:Console.hash (Journal.of_channel channel)) in
  close_in channel;
  match verdict with
  | Run { ending = { how = "completed"; _ }; _ } -> Ok ()
  | Run { ending = { how = "failed"; _ }; _ } when not is_whole -> Ok ()
  | Run _ | Prefix _ | No_run _ | Possible _ | Impossible _ | Unknown _ | Unreadable _ ->
    Error (Format.asprintf "@[<v>the journal: %a@]" Journal_verdict.pp verdict)

(* Without some of its notes a run may fail; but it starts no plan twice. *)
let rec is_twice = function plan :: (other :: _ as rest) -> plan = other || is_twice rest | [ _ ] | [] -> false

let check_vehicles ~is_whole log =
  let started = List.sort String.compare (Vehicles.started log) in
  if not is_whole then
    if is_twice started then Error ("the vehicles have started " ^ String.concat ", " started) else Ok ()
  else if started <> List.sort String.compare Mission.plans then
    Error ("the vehicles have started " ^ String.concat ", " started)
  else match Vehicles.faults log with [] -> Ok () | faults -> Error (String.concat "\n" faults)

(* {1 Trials} *)

let read path =
  let channel = open_in_bin path in
  Fun.protect ~finally:(fun () -> close_in channel) (fun () -> really_input_string channel (in_channel_length channel))

(* The files of a failure stay there, the rest does not. *)
let folder number =
  let root = Option.value (Sys.getenv_opt "DOLPHIN_KEPT") ~default:(Filename.get_temp_dir_name ()) in
  Printf.sprintf "%s/dolphin-kill-%d-%d" root (Unix.getpid ()) number

let remove folder =
  Array.iter (fun name -> Sys.remove (Filename.concat folder name)) (Sys.readdir folder);
  Unix.rmdir folder

let write path text =
  let channel = open_out_bin path in
  Fun.protect ~finally:(fun () -> close_out channel) (fun () -> output_string channel text)

let in_folder number f =
  let folder = folder number in
  Unix.mkdir folder 0o755;
  let result = f (Filename.concat folder) in
  if Result.is_ok result then remove folder;
  Result.map_error (fun why -> Printf.sprintf "%s\nall of it is in %s" why folder) result

let ( let* ) = Result.bind

(* [losing n journal] is [journal] without the last [n] notes of requests, each with the later notes and reports: as far
   as no event or transition follows, since the number of notes before that would give the loss away. *)
let losing n journal =
  let kind line =
    match Yojson.Safe.from_string line with
    | json -> (
        match Yojson.Safe.Util.(member "kind" json, member "note" json) with
        | `String "platform", `Assoc (("asked", _) :: _) -> `Request
        | `String ("platform" | "vehicle"), _ -> `Report
        | _ -> `Other)
    | exception Yojson.Json_error _ -> `Report
  in
  let rec lose n kept latest_first =
    match latest_first with
    | line :: earlier when n > 0 -> (
        match kind line with
        | `Request -> lose (n - 1) earlier earlier
        | `Report -> lose n kept earlier
        | `Other -> kept)
    | _ -> kept
  in
  let latest_first = List.rev (List.filter (fun line -> line <> "") (String.split_on_char '\n' journal)) in
  String.concat "" (List.rev_map (fun line -> line ^ "\n") (lose n latest_first latest_first))

let console ~port ~name ~is_whole death =
  match Processes.wait (Console.start ~port ~journal:(name "run") ~log:(name "consoles.log") death) with
  | WSIGNALED signal when signal = Sys.sigkill -> Ok `Killed
  | WEXITED 0 -> Ok `Completed
  | WEXITED 1 when not is_whole -> Ok `Completed
  | WEXITED code -> Error (Printf.sprintf "a console exited with status %d" code)
  | WSIGNALED signal when signal = Sys.sigalrm -> Error "a console did not come to an end"
  | WSIGNALED signal | WSTOPPED signal -> Error (Printf.sprintf "a console got signal %d" signal)

(* One console after the other; the journal as each one left it is kept. *)
let rec consoles ~port ~name ~lost pause number = function
  | [] -> Ok ()
  | death :: others -> (
      let* ending = console ~port ~name ~is_whole:(lost = 0) death in
      match ending with
      | `Completed -> Ok ()
      | `Killed ->
        write (name (Printf.sprintf "run.%d" number)) (read (name "run"));
        if lost > 0 then write (name "run") (losing lost (read (name "run")));
        Unix.sleepf pause;
        consoles ~port ~name ~lost 0. (number + 1) others)

let run t ~ports ~number =
  in_folder number (fun name ->
      let port = port ~ports number in
      write (name "trial") (Format.asprintf "%a; trial %d, ports from %d@." pp t number port);
      let vehicles = Vehicles.start ~port ~log:(name "vehicles.log") in
      let went = consoles ~port ~name ~lost:t.lost t.pause 1 [ t.death; t.again; Console.Never ] in
      Processes.stop vehicles;
      let is_whole = t.lost = 0 in
      let checked =
        let* () = went in
        let* () = check_vehicles ~is_whole (name "vehicles.log") in
        check_journal ~is_whole (name "run")
      in
      let with_files why = Printf.sprintf "%s\n%s%s" why (read (name "run")) (read (name "vehicles.log")) in
      Result.map_error with_files checked)

let lines ~ports =
  let count name =
    let port = port ~ports 0 in
    let vehicles = Vehicles.start ~port ~log:(name "vehicles.log") in
    let ending = console ~port ~name ~is_whole:true Never in
    Processes.stop vehicles;
    let is_sample line = String.length line > 17 && String.sub line 0 17 = "{\"kind\":\"vehicle\"" in
    let counts line = line <> "" && not (is_sample line) in
    let lines () = List.length (List.filter counts (String.split_on_char '\n' (read (name "run")))) in
    Result.map (fun (`Killed | `Completed) -> lines ()) ending
  in
  match in_folder 0 count with Ok lines -> lines | Error why -> failwith why
