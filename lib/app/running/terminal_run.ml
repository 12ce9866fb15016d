open Dolphin_runtime
open Dolphin_display
open Dolphin_trace
open Lwt.Infix

let is_live () =
  let dumb = match Sys.getenv_opt "TERM" with None | Some ("" | "dumb") -> true | Some _ -> false in
  Unix.isatty Unix.stdout && not dumb

type t = {
  screen : Screen.t;
  interruption : Interruption.t;
  mutable log : Log.t;
  mutable board : Status.t;
  mutable view : Run.view;
}

(* That nobody reads the log any more is no trouble: whoever did has gone, as [head] does. *)
let trouble_of_log : Unix.error -> Error.t option = function
  | EPIPE | EIO | EBADF -> None
  | error -> Some (Error.Unavailable ("the log cannot be written: " ^ Unix.error_message error))

(* {1 What is shown} *)

let print t lines = List.iter (Screen.print t.screen) lines
let remark t text = Screen.print t.screen (Log.remark t.log ~time:(t.view.now ()) text)

(* The driver interrupts stuck programs by itself. *)
let transition t ~time ~cause:_ transition =
  t.board <- Status.transition t.board ~time transition;
  let stuck = not (Interruption.happened t.interruption) in
  let log, lines = Log.transition ~stuck t.log ~time transition in
  t.log <- log;
  print t lines

let news t ~time state =
  t.board <- Status.news t.board ~time state;
  let log, lines = Log.news t.log ~time state in
  t.log <- log;
  print t lines;
  Screen.changed t.screen

(* The log and the board as they were when the console died; nothing is printed again. *)
let replayed t (entry : Entry.t) replay =
  match entry, Replay.latest replay with
  | Vehicle { time; state }, _ ->
    t.log <- fst (Log.news t.log ~time state);
    t.board <- Status.news t.board ~time state
  | Transition { time; _ }, Some (_, transition) ->
    t.log <- fst (Log.transition t.log ~time transition);
    t.board <- Status.transition t.board ~time transition
  | (Header _ | Partial _ | Label _ | Event _ | Transition _ | Note _ | Resumed _ | End _), _ -> ()

(* How far vehicles are with their plans. *)
let estimate ({ vehicle; plan; share; remaining } : Run.estimate) =
  let left = match remaining with Some t -> Printf.sprintf ", %s left" (Phrase.time t) | None -> "" in
  Printf.sprintf "         %s: %.0f%% of %s%s" (Phrase.one_line vehicle) (100. *. share) (Phrase.one_line plan) left

let board t () =
  match Status.lines t.board with [] -> [] | lines -> lines @ List.map estimate (t.view.estimates ())

(* {1 The person} *)

(* What is typed at a terminal stands there already. *)
let echo text = if Unix.isatty Unix.stdin then None else Some text

let person t : Questions.person =
  let typed = Console.scripted ~output:ignore ~answers:[] () in
  let answer prompt =
    typed.ask prompt >|= fun reply ->
    Result.iter (fun text -> Screen.answered t.screen (echo text)) reply;
    reply
  in
  { asked = (fun prompt -> Screen.ask t.screen (Log.question t.log ~time:(t.view.now ()) prompt));
    answer;
    answered = (fun text -> Screen.answered t.screen (Some text));
    refused = (fun why -> remark t ("cannot take this answer: " ^ why)) }

(* {1 The run} *)

let front t ~live ~notice ~again : Run.front =
  let opened view =
    Interruption.on_signals ~again t.interruption;
    t.view <- view;
    Screen.show t.screen (board t)
  in
  { replayed = replayed t; notice; opened; remark = remark t;
    observer = { transition = transition t; news = news t };
    person = person t; wants_telemetry = live }

let run ~notice ~again f =
  let interruption = Interruption.make () in
  let live = is_live () in
  let trouble = ref None in
  let on_closed error =
    trouble := trouble_of_log error;
    Interruption.interrupt interruption
  in
  let screen = Screen.make ~live ~on_closed Unix.stdout in
  let view : Run.view = { now = (fun () -> 0.); estimates = (fun () -> []) } in
  let t = { screen; interruption; log = Log.start; board = Status.start; view } in
  let close () =
    Screen.close screen;
    Lwt.return_unit
  in
  let result = Lwt_main.run (Lwt.finalize (fun () -> f (front t ~live ~notice ~again) ~interruption) close) in
  match result, !trouble with
  | Ok _, Some why -> Error why
  | (Ok _ | Error _), _ -> result
