open Dolphin_plans
open Dolphin_runtime
open Dolphin_trace
open Lwt.Infix

type run = {
  fleet : Fleet_file.t;
  recording : Recording.t;
  now : unit -> float;
  took : Program_file.t -> Replay.t -> unit;
}

type refusal = Busy | No_journal | Wrong_program of string | Differs of string | Over

type t = {
  run : run;
  mutable program : Program_file.t;
  inbox : (unit -> Driver.replacement option) Lwt_mvar.t;
  mutable journal : in_channel option;  (* never closed: that would give the lock of the journal away *)
  mutable is_busy : bool;
  over : unit Lwt.t;
  close : unit Lwt.u;
}

let make run program =
  let over, close = Lwt.wait () in
  { run; program; inbox = Lwt_mvar.create_empty (); journal = None; is_busy = false; over; close }

let program t = t.program
let inbox t = t.inbox
let close t = Lwt.wakeup_later t.close ()

let message = function
  | Busy -> "another replacement of the program is being checked"
  | No_journal -> "the run has no journal, or one that cannot be read again"
  | Wrong_program why -> why
  | Differs why -> "this run is not the beginning of a run of the program: " ^ why
  | Over -> "the run has ended"

(* {1 The program} *)

let ( let* ) = Result.bind

let sentence error =
  let diagnostic (d : Dolphin_syntax.Diagnostic.t) =
    Format.asprintf "%a: %s" Dolphin_syntax.Location.pp d.at d.message in
  String.concat "; " (Error.sentences error @ List.map diagnostic (Error.diagnostics error))

let same_fences a b =
  let same (a : Fences.fence) (b : Fences.fence) = Fences.equal_rule a.rule b.rule && Float.equal a.margin b.margin in
  let a = Fences.list a and b = Fences.list b in
  List.compare_lengths a b = 0 && List.for_all2 same a b

(* Fences are those of the driver that was started, and of the journal's header. *)
let load t ~set ~hash path =
  let wrong error = Wrong_program (sentence error) in
  let set = Option.value set ~default:t.program.set in
  let* program = Result.map_error wrong (Program_file.load ~set path) in
  let* program = Result.map_error wrong (Program_file.within t.run.fleet program) in
  if Option.fold hash ~none:false ~some:(fun hash -> (Program_file.header program).hash <> hash) then
    Error (Wrong_program (path ^ ": this file has changed since it was checked"))
  else if program.program.reads_time_of_day && program.program.begins = None then
    Error (Wrong_program (path ^ ": it reads the time of day, and the journal of this run does not have its date"))
  else if not (same_fences program.program.fences t.program.program.fences) then
    Error (Wrong_program (path ^ ": its fences differ: a run goes on with the fences that it began with"))
  else Ok program

(* {1 The journal} *)

let open_journal t =
  match t.journal, Recording.journal t.run.recording with
  | Some channel, _ -> seek_in channel 0; Ok channel
  | None, None -> Error No_journal
  | None, Some path -> (
      match (Unix.stat path).st_kind with
      | S_REG ->
        let channel = open_in_bin path in
        t.journal <- Some channel;
        Ok channel
      | S_DIR | S_CHR | S_BLK | S_LNK | S_FIFO | S_SOCK -> Error No_journal
      | exception Unix.Unix_error _ -> Error No_journal)

let differs verdict = Error (Differs (Format.asprintf "@[<v 2>%a@]" Journal_verdict.pp verdict))

(* The run goes on, whatever becomes of the file. *)
let guarded read = try read () with Sys_error _ -> Error No_journal

let feed replay number entry =
  match Replay.feed replay entry with
  | Ok replay -> Ok replay
  | Error mismatch ->
    differs (No_run { number; entry; transitions = Replay.transitions replay; mismatch })

(* The lines up to [size] bytes of the journal. *)
let rec read reader ~size replay =
  if Journal.whole reader >= size then Ok replay
  else
    match Journal.next reader with
    | Line { number; entry } ->
      let* replay = feed replay number entry in
      read reader ~size replay
    | End_of_file -> Ok replay
    | Torn number -> differs (Unreadable { number; why = "it is torn" })
    | Wrong { number; why } -> differs (Unreadable { number; why })

(* The most bytes that are read at a time while the run goes on: about a millisecond's work. *)
let part = 16_384

let rec read_in_parts channel reader replay =
  let now = Journal.whole reader in
  let next () =
    if in_channel_length channel - now <= part then Ok `All
    else Result.map (fun replay -> `Part replay) (read reader ~size:(now + part) replay)
  in
  match guarded next with
  | Ok `All -> Lwt.return (Ok replay)
  | Ok (`Part replay) -> Lwt.pause () >>= fun () -> read_in_parts channel reader replay
  | Error _ as refused -> Lwt.return refused

(* {1 The change} *)

(* Called by the driver, while the run waits: all lines so far are in the file. *)
let change t channel reader replay (program : Program_file.t) told () =
  match guarded (fun () -> read reader ~size:(in_channel_length channel) replay) with
  | Error _ as refused -> Lwt.wakeup_later told refused; None
  | Ok replay ->
    let time = t.run.now () in
    Recording.replace t.run.recording ~time program.program ~source:(Program_file.header program) replay;
    t.program <- program;
    t.run.took program replay;
    Lwt.wakeup_later told (Ok time);
    Some { Driver.program = program.program; configuration = Replay.configuration replay }

let offer t channel program =
  let reader = Journal.of_channel channel in
  let start = Replay.start ~hash:(Program_file.header program).hash program.program in
  read_in_parts channel reader start >>= function
  | Error _ as refused -> Lwt.return refused
  | Ok replay ->
    let answer, told = Lwt.wait () in
    let taken = Lwt_mvar.put t.inbox (change t channel reader replay program told) >>= fun () -> answer in
    Lwt.pick [ taken; (Lwt.protected t.over >|= fun () -> Error Over) ]

let replace t ?set ?hash path =
  let whole () =
    match
      let* channel = open_journal t in
      let* program = load t ~set ~hash path in
      Ok (channel, program)
    with
    | Ok (channel, program) -> offer t channel program
    | Error _ as refused -> Lwt.return refused
    | exception Sys_error why -> Lwt.return (Error (Wrong_program why))
  in
  if t.is_busy then Lwt.return (Error Busy)
  else if not (Lwt.is_sleeping t.over) then Lwt.return (Error Over)
  else begin
    t.is_busy <- true;
    Lwt.finalize whole (fun () -> t.is_busy <- false; Lwt.return_unit)
  end

let refused ?set:_ ?hash:_ _ = Lwt.return (Error Over)
