module Limits = Dolphin_checker.Limits
module Workers = Dolphin_processes.Workers

let alone (limits : Limits.t) ~count f =
  let found = List.init count (fun i -> (i, f limits i)) in
  (found, if limits.interrupted () then Some Limits.Interruption else None)

(* Time and memory are the others' to look at. *)
let await workers ~started (limits : Limits.t) measures ~phase ~count =
  let guard = Limits.guard ~started { limits with timeout = None; memory_left = (fun () -> None) } in
  let rec go found =
    if Workers.is_done workers then (found, None)
    else
      let phase = Printf.sprintf "%s, %d of %d" phase (List.length found) count in
      match Limits.look guard phase measures; Workers.next workers ~timeout:0.2 with
      | more -> go (more @ found)
      | exception Limits.Stop bound -> (found, Some bound)
      | exception Workers.Died { how; _ } -> (found, Some (Unsettled ("a worker process ended early, " ^ how)))
  in
  let found, stopped = go [] in
  (List.sort (fun (m, _) (n, _) -> Int.compare m n) found, stopped)

let all ~workers ~started (limits : Limits.t) measures ~phase ~count f =
  let jobs = if limits.max_memory = None then min workers count else 1 in
  if jobs <= 1 then alone limits ~count f
  else
    match Workers.start ~jobs ~first:0 ~last:(count - 1) (f { limits with progress = ignore }) with
    | exception Unix.Unix_error _ -> alone limits ~count f
    | workers ->
      Fun.protect
        ~finally:(fun () -> Workers.stop workers)
        (fun () -> await workers ~started limits measures ~phase ~count)
