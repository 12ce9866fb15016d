open Dolphin_runtime
open Dolphin_trace

type settings = {
  journal : string option;
  drawing : Drawing.t option;
  follower : (Entry.t -> unit) option;
}

exception Broken of string

let nothing = { journal = None; drawing = None; follower = None }
let utc_now () =
  let t = Unix.gmtime (Unix.time ()) in
  Printf.sprintf "%04d-%02d-%02dT%02d:%02d:%02dZ" (t.tm_year + 1900) (t.tm_mon + 1) t.tm_mday t.tm_hour t.tm_min
    t.tm_sec

let is_wanted s = s.journal <> None || s.drawing <> None || s.follower <> None

(* The destination of a journal. *)
type file = { path : string; channel : out_channel; is_new : bool }

type t = {
  settings : settings;
  file : file option;
  summary : Summary.builder;
  recorder : Recorder.t option Lazy.t;  (* if anything is to be kept; forced, it has begun the journal *)
  mutable is_over : bool;
}

let resumption source ~time = Entry.Resumed { time; program = source; at = utc_now () }
let trouble path why = Printf.sprintf "the journal cannot be written: %s: %s" path why

let protected path f =
  try f () with Sys_error why -> raise (Broken ("the journal cannot be written: " ^ Text_file.named path why))

(* Each line is written before its event takes effect. *)
let write_line file numbering entry =
  protected file.path (fun () ->
      output_string file.channel (Journal.line numbering entry);
      output_char file.channel '\n';
      flush file.channel)

let same_file a b =
  match Unix.stat a, Unix.stat b with
  | a, b -> a.st_dev = b.st_dev && a.st_ino = b.st_ino
  | exception Unix.Unix_error _ -> false

(* A mistyped path must not destroy a program. *)
let would_overwrite settings (header : Header.t) =
  let fleet = Option.map (fun (s : Header.source) -> s.path) header.fleet in
  let sources = header.program.path :: Option.to_list fleet in
  let outputs = Option.to_list settings.journal @ Option.to_list (Option.map Drawing.path settings.drawing) in
  List.find_opt (fun output -> List.exists (same_file output) sources) outputs

(* The lock lasts as long as the console lives, so others can see that it does. Not all files can be locked. *)
let lock path fd =
  match Unix.lockf fd F_TLOCK 0 with
  | () -> ()
  | exception Unix.Unix_error ((EAGAIN | EACCES), _, _) ->
    raise (Broken (path ^ ": another console is writing this journal"))
  | exception Unix.Unix_error _ -> ()

(* A regular file is read before anything of it is overwritten. We must not hold the reading end of a pipe: the exit
   of its reader would go unnoticed. *)
let open_mode path : Unix.open_flag =
  match (Unix.stat path).st_kind with
  | S_REG -> O_RDWR
  | S_DIR | S_CHR | S_BLK | S_LNK | S_FIFO | S_SOCK -> O_WRONLY
  | exception Unix.Unix_error _ -> O_RDWR

(* Nothing of the file is lost before it is ours. *)
let open_file path =
  let is_new = not (Sys.file_exists path) in
  match Unix.openfile path [ open_mode path; O_CREAT; O_CLOEXEC ] 0o666 with
  | fd ->
    lock path fd;
    let channel = Unix.out_channel_of_descr fd in
    set_binary_mode_out channel true;
    { path; channel; is_new }
  | exception Unix.Unix_error (error, _, _) -> raise (Broken (trouble path (Unix.error_message error)))

(* Repeating a command after the console died must not erase the record of vehicles that may still be moving. The
   channel is never closed: to close any of its file would give the lock away. *)
let spare_unfinished { path; channel; _ } =
  let fd = Unix.descr_of_out_channel channel in
  if (Unix.fstat fd).st_kind = S_REG && Journal.breaks_off (Unix.in_channel_of_descr fd) then
    raise
      (Broken
         (Printf.sprintf "%s: this is the journal of a run that broke off: go on with it by --resume %s, or remove it"
            path path))

let truncate fd length =
  match Unix.ftruncate fd length with
  | () -> ignore (Unix.lseek fd length SEEK_SET)
  | exception Unix.Unix_error _ -> ()  (* pipes and devices have no length *)

let guarded make =
  match make () with
  | r -> Ok r
  | exception (Broken why | Sys_error why) -> Error (Error.Unavailable why)

(* The journal's file is ours from now on. Its content stays until the journal begins: [clear] gets the content, and
   the lines of [make] replace it. *)
let opened ?(notes = 0) settings header summary ~check ~clear make =
  let with_file () =
    let open_checked path =
      let file = open_file path in
      check file;
      file
    in
    let file = Option.map open_checked settings.journal in
    let numbering = Journal.numbering ~notes in
    let write entry =
      Option.iter (fun file -> write_line file numbering entry) file;
      if settings.drawing <> None then Summary.add summary entry;
      Option.iter (fun follow -> follow entry) settings.follower
    in
    let begun () =
      Option.iter (fun file -> clear (Unix.descr_of_out_channel file.channel)) file;
      if is_wanted settings then Some (make write) else None
    in
    { settings; file; summary; recorder = Lazy.from_fun begun; is_over = false }
  in
  match would_overwrite settings header, Option.fold settings.drawing ~none:(Ok ()) ~some:Drawing.check with
  | Some path, _ -> Error (Error.Unavailable (path ^ ": the run was to be written over its own program or fleet"))
  | None, (Error _ as trouble) -> trouble
  | None, Ok () -> guarded with_file

let start settings header program =
  opened settings header (Summary.create ()) ~check:spare_unfinished ~clear:(fun fd -> truncate fd 0)
    (Recorder.make program header)

(* The lines of [run] that are resumed, in a file of its own. *)
let copy (run : Resumed.t) fd =
  let text = Bytes.create 65536 in
  let input = open_in_bin run.path in
  let rec go left =
    if left > 0 then
      match Stdlib.input input text 0 (min left (Bytes.length text)) with
      | 0 -> ()
      | n -> ignore (Unix.write fd text 0 n); go (left - n)
  in
  Fun.protect ~finally:(fun () -> close_in_noerr input) (fun () -> go run.past.kept)

let resume settings program ~source (run : Resumed.t) =
  let path = Option.value settings.journal ~default:run.path in
  let replay = run.past.replay in
  let is_same = same_file path run.path in
  let check file = if not is_same then spare_unfinished file in
  let clear fd =
    if is_same then truncate fd run.past.kept
    else begin
      truncate fd 0;
      copy run fd
    end
  in
  let make write =
    let recorder = Recorder.resume program replay ~seen:(Resumption.seen run.past) write in
    Recorder.write recorder ~time:(Replay.time replay) (resumption source);
    recorder
  in
  opened ~notes:run.past.notes { settings with journal = Some path } run.past.header run.summary ~check ~clear make

let begin_ r = guarded (fun () -> ignore (Lazy.force r.recorder))

let note r ~time ~vehicle note =
  let line ~time = Entry.Note { time; vehicle; note } in
  Option.iter (fun recorder -> Recorder.write recorder ~time line) (Lazy.force r.recorder)

let act r ~time act =
  let line ~time = Entry.Act { time; act } in
  if r.is_over then Ok ()
  else
    match Option.iter (fun recorder -> Recorder.write recorder ~time line) (Lazy.force r.recorder) with
    | () -> Ok ()
    | exception Broken why -> Error why

let replace r ~time program ~source replay =
  let replace recorder = Recorder.replace recorder ~time program ~line:(resumption source) replay in
  Option.iter replace (Lazy.force r.recorder)

let sync r =
  let sync file =
    let fd = Lwt_unix.of_unix_file_descr ~blocking:true ~set_flags:false (Unix.descr_of_out_channel file.channel) in
    fun () ->
      Lwt.catch
        (fun () -> Lwt_unix.fdatasync fd)
        (function
          | Unix.Unix_error (EINVAL, _, _) -> Lwt.return_unit  (* a pipe *)
          | Unix.Unix_error (error, _, _) -> Lwt.fail (Broken (trouble file.path (Unix.error_message error)))
          | error -> Lwt.fail error)
  in
  Option.map sync r.file

let journal r = Option.map (fun file -> file.path) r.file

let observer ?unasked r : Dolphin_runtime.Observer.t =
  match Lazy.force r.recorder with
  | None -> Dolphin_runtime.Observer.nobody
  | Some recorder -> { transition = Recorder.transition ?unasked recorder; news = Recorder.news recorder;
                       unknown = Dolphin_runtime.Observer.nobody.unknown }

let close r =
  let give_up file =
    close_out_noerr file.channel;
    if file.is_new && not (Lazy.is_val r.recorder) then try Sys.remove file.path with Sys_error _ -> ()
  in
  Option.iter give_up r.file

let finish r ~time ~stuck =
  r.is_over <- true;
  let close () =
    Option.iter (fun recorder -> Recorder.finish recorder ~time ~stuck) (Lazy.force r.recorder);
    Option.iter (fun file -> protected file.path (fun () -> close_out file.channel)) r.file
  in
  match close () with
  | exception Broken why -> Error (Error.Unavailable why)
  | () -> (
      match r.settings.drawing with
      | None -> Ok ()
      | Some drawing -> Drawing.write drawing (Summary.finish r.summary))
