open Lwt.Infix

type t = {
  mutable waiting : unit Lwt.u option;  (* [next] *)
  mutable closing : unit Lwt.u option;  (* [until_quiet] *)
  mutable armed : float;  (* when [watch] looks again *)
  mutable rearm : unit Lwt.u option;
  mutable failure : exn option;
  mutable is_closed : bool;
}

let make () =
  { waiting = None; closing = None; armed = infinity; rearm = None; failure = None; is_closed = false }

let wake waiting = Option.iter (fun u -> Lwt.wakeup_later u ()) waiting

let wake_next s =
  let waiting = s.waiting in
  s.waiting <- None;
  wake waiting

let wake_watch s =
  let rearm = s.rearm in
  s.rearm <- None;
  wake rearm

let settle s ~has_event ~quiet ~due =
  if has_event then wake_next s;
  if s.closing <> None && quiet () then begin
    let closing = s.closing in
    s.closing <- None;
    wake closing
  end;
  if due < s.armed then wake_watch s

let longest_sleep = 3600.

let rec watch s ~now ~due ~tick =
  if s.is_closed then Lwt.return_unit
  else begin
    let time = now () in
    if due () <= time then begin
      s.armed <- infinity;
      tick ~now:time
    end;
    let rang, rearm = Lwt.task () in
    s.armed <- due ();
    s.rearm <- Some rearm;
    let seconds = Float.max 0.0005 (Float.min longest_sleep (s.armed -. now ())) in
    Lwt.pick [ rang; Lwt_unix.sleep seconds ] >>= fun () -> watch s ~now ~due ~tick
  end

let rec next s take =
  match s.failure, take () with
  | _, Some event -> Lwt.return event
  | Some error, None -> Lwt.fail error
  | None, None ->
    let promise, waiting = Lwt.task () in
    s.waiting <- Some waiting;
    promise >>= fun () -> next s take

let until_quiet s =
  let quiet, closing = Lwt.task () in
  s.closing <- Some closing;
  quiet

let fail s error =
  if s.failure = None && not s.is_closed then begin
    s.failure <- Some error;
    wake_next s
  end

let is_closed s = s.is_closed

let close s =
  s.is_closed <- true;
  wake_watch s
