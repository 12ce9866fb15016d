type t = { promise : unit Lwt.t; wake : unit Lwt.u; mutable happened : bool }

let make () =
  let promise, wake = Lwt.wait () in
  { promise; wake; happened = false }

let interrupt i =
  if not i.happened then begin
    i.happened <- true;
    Lwt.wakeup_later i.wake ()
  end

(* Signals may come at any point of the program: the first one only asks the event loop, which breathes often, to
   interrupt. The second one need not wait for it. *)
let on_signals ?again i =
  let notification = Lwt_unix.make_notification ~once:true (fun () -> interrupt i) in
  let signals = ref 0 in
  let behaviour =
    Sys.Signal_handle
      (fun _ ->
         incr signals;
         if !signals = 1 && not i.happened then Lwt_unix.send_notification notification
         else Option.iter (fun again -> ignore (again ())) again)
  in
  List.iter (fun signal -> Sys.set_signal signal behaviour) [ Sys.sigint; Sys.sigterm ];
  match Sys.signal Sys.sighup behaviour with
  | Signal_ignore -> Sys.set_signal Sys.sighup Signal_ignore
  | Signal_default | Signal_handle _ -> ()

let promise i = i.promise
let happened i = i.happened
