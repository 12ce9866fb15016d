open Lwt.Infix

type stage = { promise : unit Lwt.t; wake : unit Lwt.u; mutable happened : bool }
type t = {
  first : stage;
  second : stage;
  breakable : Dolphin_runtime.Breakable.t;
  mutable unasked : bool;
}

let stage () =
  let promise, wake = Lwt.wait () in
  { promise; wake; happened = false }

let make () = { first = stage (); second = stage (); breakable = Dolphin_runtime.Breakable.make (); unasked = false }

let happen stage =
  if not stage.happened then begin
    stage.happened <- true;
    Lwt.wakeup_later stage.wake ()
  end

let interrupt i = happen i.first
let once_more i = if i.first.happened then happen i.second else happen i.first

(* From a handler of a signal: a step that is being computed is broken off, anything else comes to the event loop. *)
let ask i notification request =
  Dolphin_runtime.Breakable.break i.breakable request;
  Lwt_unix.send_notification notification

(* A limit on processor time or file size repeats its signal, and others come from timers or from programs that mean
   another process: these never end the process at once while vehicles move. *)
let on_mild_signals i =
  let notification = Lwt_unix.make_notification (fun () -> interrupt i) in
  let handle _ = if not i.first.happened then ask i notification (fun () -> interrupt i) in
  let behaviour = Sys.Signal_handle handle in
  List.iter (fun signal -> Sys.set_signal signal behaviour) Dolphin_processes.Ending_signals.others

(* Signals may come at any point of the program: one that interrupts asks the event loop, which breathes often but for
   long steps, to do so. The last one need not wait for it. *)
let on_signals ?(goes_on = fun () -> false) ?again i =
  let notification = Lwt_unix.make_notification (fun () -> once_more i) in
  let asked = ref 0 in
  let behaviour =
    Sys.Signal_handle
      (fun _ ->
         let before = max !asked (if i.second.happened then 2 else if i.first.happened then 1 else 0) in
         asked := before + 1;
         if before = 0 || (before = 1 && goes_on ()) then ask i notification (fun () -> once_more i)
         else Option.iter (fun again -> ignore (again ())) again)
  in
  on_mild_signals i;
  List.iter (fun signal -> Sys.set_signal signal behaviour) Dolphin_processes.Ending_signals.requests;
  match Sys.signal Sys.sighup behaviour with
  | Signal_ignore -> Sys.set_signal Sys.sighup Signal_ignore
  | Signal_default | Signal_handle _ -> ()

let promise i = i.first.promise
let again i = i.second.promise
let breakable i = i.breakable
let happened i = i.first.happened

let unless i f =
  let result = f () in
  let settled = Lwt.catch (fun () -> result >|= ignore) (fun _ -> Lwt.return_unit) in
  Lwt.choose [ settled; promise i ] >>= fun () ->
  Lwt.cancel result;
  Lwt.catch (fun () -> result >|= Option.some) (function Lwt.Canceled -> Lwt.return_none | error -> Lwt.fail error)

let unasked i interrupt =
  i.unasked <- true;
  Fun.protect ~finally:(fun () -> i.unasked <- false) interrupt

let is_unasked i = i.unasked
