type t = { promise : unit Lwt.t; wake : unit Lwt.u; mutable happened : bool }

let interrupt i =
  if not i.happened then begin
    i.happened <- true;
    Lwt.wakeup_later i.wake ()
  end

(* Signals may come at any point of the program: the first one only asks the event loop, which breathes often, to
   interrupt. The second one need not wait for it. *)
let on_signal ?last_words i notification =
  let signals = ref 0 in
  Sys.Signal_handle
    (fun _ ->
       incr signals;
       if !signals > 1 || i.happened then begin
         (try Option.iter Report.complain last_words with Sys_error _ -> ());
         Unix._exit (Exit_status.code Interrupted)
       end
       else Lwt_unix.send_notification notification)

let make ?last_words () =
  let promise, wake = Lwt.wait () in
  let i = { promise; wake; happened = false } in
  let notification = Lwt_unix.make_notification ~once:true (fun () -> interrupt i) in
  let behaviour = on_signal ?last_words i notification in
  List.iter (fun signal -> Sys.set_signal signal behaviour) [ Sys.sigint; Sys.sigterm ];
  (match Sys.signal Sys.sighup behaviour with
   | Signal_ignore -> Sys.set_signal Sys.sighup Signal_ignore
   | Signal_default | Signal_handle _ -> ());
  i

let promise i = i.promise
let happened i = i.happened
