open Dolphin_semantics
open Dolphin_runtime
open Dolphin_display
open Dolphin_trace
open Lwt.Infix

type show = { quiet : bool; only : string list; colour : bool option; journal : string option }

type t = {
  screen : Screen.t;
  interruption : Interruption.t;
  mutable program : Program_file.t;
  show : show;
  live : bool;
  colour : bool;
  mutable log : Log.t;
  mutable board : Status.t;
  mutable outcome : Run_summary.t;
  mutable configuration : Configuration.t;
  mutable world : World.t;
  mutable view : Run.view;
  mutable keyboard : Keyboard.t option;  (* if there is keyboard input *)
  mutable answered : bool;  (* the latest answer stands behind its question *)
}

(* Ignore EPIPE: the reader of the log has gone, as [head] does. *)
let trouble_of_log : Unix.error -> Error.t option = function
  | EPIPE | EIO | EBADF -> None
  | error -> Some (Error.Unavailable ("the log cannot be written: " ^ Unix.error_message error))

(* {1 What is shown} *)

let print t line =
  if Log.is_shown ~quiet:t.show.quiet ~only:t.show.only line then
    Screen.print t.screen (Log.tint ~colour:t.colour line)

let remark t text = print t (Log.remark t.log ~time:(t.view.now ()) text)

let see_transition t ~time (transition : Transition.t) =
  t.board <- Status.transition t.board ~time transition;
  t.outcome <- Run_summary.transition t.outcome ~time transition;
  t.configuration <- transition.next

let see_vehicle t state =
  t.board <- Status.news t.board state;
  t.world <- World.add state t.world

(* The answer to the question of a task, if it was not typed behind it: it was answered elsewhere, or after other
   lines. *)
let tell_answer t ~time cause =
  match (cause : Transition.event option) with
  | Some (Confirmed (_, Ok yes)) ->
    let text = if yes then "yes" else "no" in
    if Screen.is_asking t.screen then Screen.answered t.screen (Some text)
    else if not t.answered then print t (Log.remark t.log ~time ("is answered: " ^ text));
    t.answered <- false
  | Some _ | None -> ()

let transition t ~time ~cause transition =
  let stuck = Interruption.is_unasked t.interruption in
  tell_answer t ~time cause;
  see_transition t ~time transition;
  let log, lines = Log.transition ~stuck t.log ~time transition in
  t.log <- log;
  List.iter (print t) lines

let news t ~time state =
  see_vehicle t state;
  let log, lines = Log.news t.log ~time state in
  t.log <- log;
  List.iter (print t) lines;
  Screen.changed t.screen

let unknown t ~time:_ (fault : Fault.t) =
  let { Program_file.program; _ } = t.program in
  let text = Format.asprintf "%a: " Dolphin_syntax.Location.pp in
  let at = Option.fold (Fault.location program fault) ~none:"" ~some:text in
  remark t (Printf.sprintf "%sthis condition does not hold: %s" at fault.message)

(* The log and the board as they were when the console died; nothing is printed again. *)
let replayed t (entry : Entry.t) replay =
  let time = Replay.time replay in
  t.view <- { t.view with now = (fun () -> time) };
  match entry, Replay.latest replay with
  | Vehicle { time; state }, _ ->
    t.log <- fst (Log.news t.log ~time state);
    see_vehicle t state
  | Transition { time; _ }, Some (_, transition) ->
    t.log <- fst (Log.transition ~stuck:(Replay.was_stuck replay) t.log ~time transition);
    see_transition t ~time transition
  | (Header _ | Partial _ | Label _ | Event _ | Transition _ | Note _ | Act _ | Resumed _ | End _), _ -> ()

let replaced t (program : Program_file.t) replay =
  t.program <- program;
  t.configuration <- Replay.configuration replay;
  remark t ("the run goes on with " ^ program.path);
  Screen.changed t.screen

(* How far vehicles are with their plans. *)
let estimate estimates v =
  let of_it ({ share; remaining; _ } : Run.estimate) =
    let left = match remaining with Some t -> Printf.sprintf ", %s left" (Phrase.time t) | None -> "" in
    Printf.sprintf "%.0f%%%s" (100. *. share) left
  in
  Option.map of_it (List.find_opt (fun (e : Run.estimate) -> e.vehicle = v) estimates)

let board t ~rows ~columns =
  let { Program_file.program; source; _ } = t.program in
  Status.lines t.board ~now:(t.view.now ())
    ~estimate:(estimate (t.view.estimates ()))
    ~waiting:(Waiting.list program ~source (World.at (Exactly (World.whole (t.view.now ()))) t.world) t.configuration)
    ~rows ~columns ~colour:t.colour

(* The time passes and the terminal changes its size although nothing happens. *)
let rec refresh t =
  Lwt_unix.sleep 1. >>= fun () ->
  Screen.changed t.screen;
  refresh t

(* {1 The person} *)

(* Text typed at a terminal stands there already. *)
let echo text = if Unix.isatty Unix.stdin then None else Some text

(* A line that answers no question is an input. *)
let offer t text =
  let program = t.program.program in
  let post (key, x) =
    let declared = Typed_input.declared program ~questions:(t.view.questions ()) key in
    match Result.bind declared (fun () -> Typed_input.fits program key x) with
    | Error why -> remark t why
    | Ok () -> Lwt.async (fun () -> Lwt.map ignore (t.view.post key x))
  in
  if program.inputs @ t.view.questions () <> [] && String.trim text <> "" then
    match Typed_input.read text with Ok pairs -> List.iter post pairs | Error why -> remark t why

let answered t text =
  t.answered <- Screen.is_asking t.screen;
  Screen.answered t.screen (Option.map Phrase.one_line text)

(* A pair with a declared key is an input, also where an answer is awaited. *)
let is_input t text =
  match if String.contains text ':' then Typed_input.read text else Error "" with
  | Ok pairs -> List.for_all (fun (key, _) -> List.mem key t.program.program.inputs) pairs
  | Error _ -> false

let rec typed_answer t keyboard =
  Keyboard.answer keyboard >>= function
  | Ok text when is_input t text -> offer t text; typed_answer t keyboard
  | reply -> Lwt.return reply

(* For the typist: the form of an answer. *)
let with_what_it_takes t prompt =
  let { Program_file.program; source; _ } = t.program in
  let yes_or_no = " (yes or no)" in
  if t.keyboard = None || String.ends_with ~suffix:yes_or_no prompt then prompt
  else if (Waiting.question program ~source t.configuration prompt).is_confirm then prompt ^ yes_or_no
  else prompt ^ " (a value: 2, 'text', yes or no)"

let person t : Questions.person =
  let typed = Console.scripted ~output:ignore ~answers:[] () in
  let answer prompt =
    (match t.keyboard with Some keyboard -> typed_answer t keyboard | None -> typed.ask prompt) >|= fun reply ->
    Result.iter (fun text -> answered t (echo text)) reply;
    reply
  in
  let asked prompt =
    Option.iter Keyboard.settle t.keyboard;
    Screen.ask t.screen (Log.question t.log ~time:(t.view.now ()) (with_what_it_takes t prompt))
  in
  { asked;
    answer;
    answered = (fun text -> answered t (Some text));
    refused = (fun why -> remark t ("cannot take this answer: " ^ why)) }

(* {1 The run} *)

(* Ctrl-Z: the terminal is left as it was found, and found again. *)
let stop_on_request t =
  let rec on_signal () =
    let notification = Lwt_unix.make_notification ~once:true stop in
    Sys.set_signal Sys.sigtstp (Signal_handle (fun _ -> Lwt_unix.send_notification notification))
  and stop () =
    Screen.suspend t.screen ~stop:(fun () ->
        Sys.set_signal Sys.sigtstp Signal_default;
        Unix.kill (Unix.getpid ()) Sys.sigtstp);
    on_signal ()
  in
  if t.live then on_signal ()

(* Whether the program goes on when it is interrupted: it executes what it declares by onInterrupt. *)
let goes_on t () =
  let c = t.configuration in
  match c.control with
  | Ended _ -> false
  | Script m | Waiting (m, _) | Executing (m, _) ->
    Transition.is_leaving c || Transition.on_interrupt t.program.program c.shared m <> None

let front t ~notice : Run.front =
  let opened view =
    stop_on_request t;
    t.view <- view;
    if Unix.isatty Unix.stdin then t.keyboard <- Some (Keyboard.start ~other:(offer t));
    Screen.show t.screen (board t)
  in
  { replayed = replayed t; notice; opened; remark = remark t; replaced = replaced t;
    observer = { transition = transition t; news = news t; unknown = unknown t };
    person = person t; wants_telemetry = t.live }

let summarise t =
  if t.live || t.show.quiet then
    List.iter (Screen.print t.screen)
      (Run_summary.lines t.outcome ~now:(t.view.now ()) ~journal:t.show.journal ~colour:t.colour)

let has_no_colour () = match Sys.getenv_opt "NO_COLOR" with None | Some "" -> false | Some _ -> true

let make show program interruption ~on_closed =
  let live = Terminal.is_live () in
  { screen = Screen.make ~live ~on_closed Unix.stdout;
    interruption; program; show; live;
    colour = Option.value show.colour ~default:(live && not (has_no_colour ()));
    log = Log.start; board = Status.start; outcome = Run_summary.start;
    configuration = Configuration.initial program.program;
    world = World.empty;
    view =
      { now = (fun () -> 0.); estimates = (fun () -> []); post = (fun _ _ -> Lwt.return_false);
        questions = (fun () -> []); replace = Replacement.refused; acted = (fun _ -> Ok ()) };
    keyboard = None; answered = false }

let run ~notice ~again show program f =
  let interruption = Interruption.make () in
  let trouble = ref None in
  let on_closed error =
    trouble := trouble_of_log error;
    Interruption.interrupt interruption
  in
  let t = make show program interruption ~on_closed in
  let again () =
    Screen.restore t.screen;
    again ()
  in
  Interruption.on_signals ~goes_on:(goes_on t) ~again interruption;
  let refreshed = if t.live then refresh t else Lwt.return_unit in
  let close () =
    Lwt.cancel refreshed;
    summarise t;
    Screen.close t.screen;
    Lwt.return_unit
  in
  let result = Lwt_main.run (Lwt.finalize (fun () -> f (front t ~notice) ~interruption) close) in
  match result, !trouble with
  | Ok _, Some why -> Error why
  | (Ok _ | Error _), _ -> Result.map (fun outcome -> (outcome, t.program)) result
