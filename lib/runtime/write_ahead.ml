open Lwt.Infix

type 'a t = {
  sync : unit -> unit Lwt.t;
  leave : string list -> 'a list -> unit;
  failed : string list -> exn -> unit;
  mutable is_waiting : bool;
  mutable vehicles : string list;  (* whose notes wait for the next sync, latest first *)
  mutable messages : 'a list;  (* latest first *)
}

let make ~sync ~leave ~failed = { sync; leave; failed; is_waiting = false; vehicles = []; messages = [] }
let is_waiting w = w.is_waiting
let enqueue w message = w.messages <- message :: w.messages

(* All that waits now. *)
let take w =
  let vehicles = List.rev w.vehicles and messages = List.rev w.messages in
  w.vehicles <- [];
  w.messages <- [];
  (vehicles, messages)

let rec sync w =
  let vehicles, messages = take w in
  Lwt.try_bind w.sync
    (fun () -> w.leave vehicles messages; Lwt.return_unit)
    (fun error -> w.failed vehicles error; Lwt.return_unit)
  >>= fun () ->
  if w.vehicles <> [] then sync w
  else begin
    w.is_waiting <- false;
    let _, messages = take w in
    w.leave [] messages;
    Lwt.return_unit
  end

(* Notes that are kept before others have their turn share its sync. *)
let require w vehicle =
  w.vehicles <- vehicle :: w.vehicles;
  if not w.is_waiting then begin
    w.is_waiting <- true;
    Lwt.async (fun () -> Lwt.pause () >>= fun () -> sync w)
  end
