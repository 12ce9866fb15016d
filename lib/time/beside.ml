module Limits = Dolphin_checker.Limits
module Workers = Dolphin_processes.Workers

type 'a t = { workers : 'a Workers.t; mutable found : (int * 'a) list; mutable stopped : Limits.bound option }

let start ~workers limits ~count f =
  let limits = { limits with Limits.progress = ignore } in
  match Workers.start ~jobs:(min workers count) ~first:0 ~last:(count - 1) (f limits) with
  | workers -> Some { workers; found = []; stopped = None }
  | exception Unix.Unix_error _ -> None

let is_over t = t.stopped <> None || Workers.is_done t.workers

let look t ~timeout =
  match if is_over t then [] else Workers.next t.workers ~timeout with
  | found -> t.found <- found @ t.found
  | exception Workers.Died { how; _ } -> t.stopped <- Some (Unsettled ("a worker process ended early, " ^ how))

let so_far t =
  look t ~timeout:0.;
  (t.found, t.stopped)

(* Time and memory are the others' to look at. *)
let await t ~started limits measures phase =
  let limits = { limits with Limits.timeout = None; max_memory = None; memory_left = (fun () -> None) } in
  let guard = Limits.guard ~started limits in
  let rec go () =
    if not (is_over t) then
      match Limits.look guard phase measures with
      | () -> look t ~timeout:0.2; go ()
      | exception Limits.Stop bound -> t.stopped <- Some bound
  in
  go ();
  (List.sort (fun (m, _) (n, _) -> compare m n) t.found, t.stopped)

let stop t = Workers.stop t.workers
