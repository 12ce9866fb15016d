open Dolphin_app
open Dolphin_json
open Exchange

let beside journal = Filename.remove_extension journal ^ ".notes"

(* A link could lead out of the folder. *)
let is_own path =
  match Unix.lstat path with
  | { st_kind = S_REG; st_nlink = 1; _ } -> true
  | _ -> false
  | exception Unix.Unix_error (ENOENT, _, _) -> true
  | exception Unix.Unix_error _ -> false

let file w ~run ~path =
  let* journal = Kept_runs.journal w ~run ~path in
  let file = beside journal in
  if is_own file then Ok file else refuse 422 "not-saved" "the file for its notes is a link, or not a file"

(* {1 Reading} *)

let of_line line =
  let open Field in
  let note =
    let* found = Result.bind (Host_value.parse line) members in
    let* time = Field.get number "time" found in
    let* text = Field.get text "text" found in
    let* by = Field.get (nullable Field.text) "by" found in
    let* at = Field.get Field.text "at" found in
    Ok (time, text, by, at)
  in
  match note with
  | Error _ -> None
  | Ok (time, text, by, at) ->
    let by = Field.of_option (fun name -> `String name) by in
    Some (`Assoc [ ("time", Canonical.number time); ("text", `String text); ("by", by); ("at", `String at) ])

let read file =
  if Sys.file_exists file then
    Result.map_error (fun e -> refusal 422 "no-journal" (String.concat "; " (Error.sentences e))) (Text_file.read file)
  else Ok ""

let listed file =
  Result.map (fun text -> `Assoc [ ("notes", `List (List.filter_map of_line (String.split_on_char '\n' text))) ])
    (read file)

let list w (r : Dolphin_http.Request.t) =
  let* file = file w ~run:(Dolphin_http.Request.parameter r "run") ~path:(Dolphin_http.Request.parameter r "path") in
  listed file

(* {1 Writing} *)

let longest = 2_000
let most_bytes = 1024 * 1024

let append file line =
  match Unix.openfile file [ O_WRONLY; O_APPEND; O_CREAT; O_CLOEXEC ] 0o644 with
  | exception Unix.Unix_error (error, _, _) -> refuse 422 "not-saved" (Unix.error_message error)
  | fd ->
    (* In one piece: others may write at the same time. *)
    let write () = Unix.write_substring fd line 0 (String.length line) = String.length line in
    (match Fun.protect ~finally:(fun () -> Unix.close fd) write with
     | true -> Ok ()
     | false -> refuse 422 "not-saved" "the note was not written to its end"
     | exception Unix.Unix_error (error, _, _) -> refuse 422 "not-saved" (Unix.error_message error))

let add w found =
  let* run = optional Field.text "run" found in
  let* path = optional Field.text "path" found in
  let* time = get Field.number "time" found in
  let* text = get Field.text "text" found in
  let* by = optional Field.text "by" found in
  let* file = file w ~run ~path in
  let* before = read file in
  let text = String.trim text in
  if text = "" || not (Float.is_finite time && time >= 0.) then bad "a note has a text, and a time of the run"
  else if String.length text > longest || String.length before > most_bytes then
    refuse 413 "too-large" (Printf.sprintf "a note has at most %d bytes, and all of a run one MiB" longest)
  else
    (* A line that was not written to its end stays one of its own. *)
    let torn = before <> "" && before.[String.length before - 1] <> '\n' in
    let line =
      Canonical.to_string
        (`Assoc [ ("time", Canonical.number time); ("text", `String text);
                  ("by", Field.of_option (fun name -> `String name) by); ("at", `String (Recording.utc_now ())) ]) in
    let* () = append file ((if torn then "\n" else "") ^ line ^ "\n") in
    listed file
