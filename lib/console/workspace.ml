open Dolphin_app
open Exchange

type t = { folder : Folder.t; fleet : string option; own : string option }

let file w path = Result.map_error (refusal 404 "not-found") (Folder.find w.folder path)

let of_error ~file ~source e =
  let message = match Error.sentences e with [] -> "the text has faults" | found -> String.concat "; " found in
  refusal ~more:[ ("diagnostics", Documents.of_error ~file ~source e) ] 422 "faults" message

let text path = Result.map_error (fun e -> refusal 404 "not-found" (String.concat "; " (Error.sentences e)))
    (Text_file.read path)

let program w ?(set = []) path =
  let* full = file w path in
  let* source = text full in
  Result.map_error (of_error ~file:full ~source) (Program_file.load ~set ~may_read:(Folder.may_read w.folder) full)

(* That of the command line may lie anywhere; a file beside the program does not count if it is a link to elsewhere. *)
let fleet_path w ~program named =
  let is_here path = Folder.may_read w.folder path = Ok () in
  match named, w.fleet with
  | Some path, _ | None, Some path -> Some path
  | None, None -> Option.bind (Fleet_file.choose ~program None) (fun path -> if is_here path then Some path else None)

let fleet w ~program named =
  let* named = match named with Some path -> Result.map Option.some (file w path) | None -> Ok None in
  let path = fleet_path w ~program named in
  let source = Option.fold path ~none:"" ~some:(fun path -> Result.value (Text_file.read path) ~default:"") in
  Result.map_error (of_error ~file:program ~source) (Fleet_file.load ~may_read:(Folder.may_read w.folder) path)

let within fleet (p : Program_file.t) =
  Result.map_error (of_error ~file:p.path ~source:p.source) (Program_file.within fleet p)

let program_in_fleet w ~set ~fleet:named path =
  let* program = program w ~set path in
  let* fleet = fleet w ~program:program.path named in
  Result.map (fun program -> (program, fleet)) (within fleet program)
