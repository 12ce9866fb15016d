open Dolphin_results
open Dolphin_conformance

let ( let* ) = Result.bind

(* {1 Cases} *)

let is_case path = Filename.check_suffix path ".json"

let rec files path =
  if not (Sys.file_exists path) then Error (Error.Bad_input (path ^ ": no such file or directory"))
  else if not (Sys.is_directory path) then Ok [ path ]
  else
    let inside name =
      let path = Filename.concat path name in
      if Sys.is_directory path then if name = "schema" then Ok [] else files path
      else Ok (if is_case path then [ path ] else [])
    in
    let entries = Sys.readdir path in
    Array.sort String.compare entries;
    Results.concat_map inside (Array.to_list entries)

let read path =
  let* source = Text_file.read path in
  Result.map_error
    (fun why -> Error.Bad_input (Printf.sprintf "%s: %s" path why))
    (Case.of_string ~path source)

let load paths =
  let* files = Results.concat_map files paths in
  let* cases = Results.map read files in
  if cases = [] then Error (Error.Bad_input (String.concat ", " paths ^ ": no cases here")) else Ok cases

(* {1 Implementations} *)

(* This implementation, asked as others are, without the text in between. *)
let ourselves ~name : Dialogue.ask =
  let oracle = ref (Oracle.start ~name) in
  fun request ->
    let after, reply = Oracle.answer !oracle request in
    oracle := after;
    Ok reply

let with_implementation ~name ~timeout command f =
  match command with
  | None -> f (ourselves ~name)
  | Some command ->
    let implementation = Implementation.make ~timeout command in
    let finally () = Implementation.close implementation in
    (* It leads a session of its own, so Ctrl-C is for us alone, and we end it. *)
    let ends = Dolphin_processes.Ending_signals.requests @ Dolphin_processes.Ending_signals.others in
    List.iter (fun s -> Sys.set_signal s (Signal_handle (fun _ -> raise Sys.Break))) ends;
    Fun.protect ~finally (fun () -> f (Implementation.ask implementation))

(* {1 Judging} *)

type judged = { case : Case.t; verdict : Judge.verdict; passed : bool }

let add_to_matrix matrix { case; verdict; passed = _ } =
  if case.fails <> [] then matrix
  else
    let name = Filename.(concat (basename (dirname case.path)) (remove_extension (basename case.path))) in
    Matrix.add ~name ~covers:case.covers ~taken:verdict.rules matrix

let judge ask tell cases =
  let judge case =
    let verdict = Judge.judge ask case in
    let judged = { case; verdict; passed = Judge.passes case verdict } in
    tell judged;
    judged
  in
  let all = List.map judge cases in
  (all, List.fold_left add_to_matrix Matrix.empty all)
