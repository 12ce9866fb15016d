open Dolphin_trace

type t = { death : Console.death; again : Console.death; pause : float }

let pp ppf t =
  let death ppf : Console.death -> unit = function
    | Before i -> Format.fprintf ppf "before line %d" i
    | Within i -> Format.fprintf ppf "within line %d" i
    | After i -> Format.fprintf ppf "after line %d" i
    | Never -> Format.fprintf ppf "never"
  in
  Format.fprintf ppf "killed %a, %g s later resumed" death t.death t.pause;
  if t.again <> Never then Format.fprintf ppf ", killed %a" death t.again

(* Below those that systems give out by themselves, and apart from those of the same tests elsewhere on this machine. *)
let ports_of_one = 16
let most_at_once = 40

let port number =
  let slot = Unix.getppid () mod 20 in
  20000 + (((slot * most_at_once) + (number mod most_at_once)) * ports_of_one)


(* {1 What must be so afterwards} *)

let check_journal path =
  let channel = open_in_bin path in
  let verdict = snd (Verdict.check Console.program ~hash:Console.hash (Journal.of_channel channel)) in
  close_in channel;
  match verdict with
  | Run { ending = { how = "completed"; _ }; _ } -> Ok ()
  | Run _ | Prefix _ | No_run _ | Possible _ | Impossible _ | Unknown _ | Unreadable _ ->
    Error (Format.asprintf "@[<v>the journal: %a@]" Verdict.pp verdict)

let check_vehicles log =
  let started = List.sort String.compare (Vehicles.started log) in
  if started <> List.sort String.compare Mission.plans then
    Error ("the vehicles have started " ^ String.concat ", " started)
  else match Vehicles.faults log with [] -> Ok () | faults -> Error (String.concat "\n" faults)

(* {1 Trials} *)

let read path =
  let channel = open_in_bin path in
  Fun.protect ~finally:(fun () -> close_in channel) (fun () -> really_input_string channel (in_channel_length channel))

let in_folder number f =
  let folder = Filename.get_temp_dir_name () in
  let name file = Printf.sprintf "%s/dolphin-kill-%d-%d.%s" folder (Unix.getpid ()) number file in
  let journal = name "run" and log = name "log" in
  let remove path = if Sys.file_exists path then Sys.remove path in
  Fun.protect ~finally:(fun () -> List.iter remove [ journal; log ]) (fun () -> f ~journal ~log)

let ( let* ) = Result.bind

let console ~port ~journal death =
  match Processes.wait (Console.start ~port ~journal death) with
  | WSIGNALED signal when signal = Sys.sigkill -> Ok `Killed
  | WEXITED 0 -> Ok `Completed
  | WEXITED code -> Error (Printf.sprintf "a console exited with status %d" code)
  | WSIGNALED signal when signal = Sys.sigalrm -> Error "a console did not come to an end"
  | WSIGNALED signal | WSTOPPED signal -> Error (Printf.sprintf "a console got signal %d" signal)

let run t ~number =
  in_folder number (fun ~journal ~log ->
      let port = port number in
      let vehicles = Vehicles.start ~port ~log in
      let rec consoles pause = function
        | [] -> Ok ()
        | death :: others -> (
            let* ending = console ~port ~journal death in
            match ending with
            | `Completed -> Ok ()
            | `Killed ->
              Unix.sleepf pause;
              consoles 0. others)
      in
      let went = consoles t.pause [ t.death; t.again; Console.Never ] in
      Processes.stop vehicles;
      let checked = let* () = went in let* () = check_vehicles log in check_journal journal in
      let with_files why = Printf.sprintf "%s\n%s%s" why (read journal) (read log) in
      Result.map_error with_files checked)

let lines () =
  in_folder 0 (fun ~journal ~log ->
      let vehicles = Vehicles.start ~port:(port 0) ~log in
      let ending = console ~port:(port 0) ~journal Never in
      Processes.stop vehicles;
      match ending with
      | Error why -> failwith (why ^ "\n" ^ read journal ^ read log)
      | Ok (`Killed | `Completed) ->
        let is_sample line = String.length line > 17 && String.sub line 0 17 = "{\"kind\":\"vehicle\"" in
        let counts line = line <> "" && not (is_sample line) in
        List.length (List.filter counts (String.split_on_char '\n' (read journal))))
