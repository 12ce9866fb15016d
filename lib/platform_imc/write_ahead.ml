open Lwt.Infix

type 'a t = {
  sync : unit -> unit Lwt.t;
  leave : string list -> 'a list -> unit;
  failed : string list -> exn -> unit;
  mutable shut : bool;
  mutable vehicles : string list;  (* whose requests wait for the next turn of the disk, latest first *)
  mutable waiting : 'a list;  (* latest first *)
}

let make ~sync ~leave ~failed = { sync; leave; failed; shut = false; vehicles = []; waiting = [] }
let is_shut g = g.shut
let hold g message = g.waiting <- message :: g.waiting

(* All that waits now. *)
let take g =
  let vehicles = List.rev g.vehicles and messages = List.rev g.waiting in
  g.vehicles <- [];
  g.waiting <- [];
  (vehicles, messages)

let rec turn g =
  let vehicles, messages = take g in
  Lwt.try_bind g.sync
    (fun () -> g.leave vehicles messages; Lwt.return_unit)
    (fun error -> g.failed vehicles error; Lwt.return_unit)
  >>= fun () ->
  if g.vehicles <> [] then turn g
  else begin
    g.shut <- false;
    let _, messages = take g in
    g.leave [] messages;
    Lwt.return_unit
  end

(* What is kept before others have their turn goes to the disk with it. *)
let shut g vehicle =
  g.vehicles <- vehicle :: g.vehicles;
  if not g.shut then begin
    g.shut <- true;
    Lwt.async (fun () -> Lwt.pause () >>= fun () -> turn g)
  end
