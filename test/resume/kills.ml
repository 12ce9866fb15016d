let soon = 0.
let late = 0.7  (* whatever runs and has an end has ended *)

let all lines =
  let deaths i = [ Console.Before i; Within i; After i ] in
  let points = List.concat_map deaths (List.init lines Fun.id) in
  let of_point k (death : Console.death) : Trial.t list =
    let first : Trial.t = { death; again = Never; pause = (if k mod 2 = 0 then soon else late); lost = 0 } in
    let second = { first with again = After (lines / 2); pause = (if k mod 2 = 0 then late else soon) } in
    if k mod 3 = 1 then [ first ] else [ first; second ]
  in
  List.concat (List.mapi of_point points)

(* The journal has lost its end: after each line, so that each request is hit. *)
let all_losing lines =
  let trial i : Trial.t =
    { death = After i; again = Never; pause = (if i mod 2 = 0 then soon else late); lost = 1 + (i mod 3 / 2) } in
  List.init lines trial

(* If there are fewer, they are repeated. *)
let sample n trials =
  let trials = Array.of_list trials in
  List.init n (fun i -> trials.(i * Array.length trials / n))

let at_once = 10

(* A process for each, a limited number at once; returns the numbers of those that fail. *)
let run_all ~ports trials =
  let failed = ref [] and running = Hashtbl.create 16 in
  let wait () =
    match Unix.wait () with
    | pid, status ->
      let number, trial = Hashtbl.find running pid in
      Hashtbl.remove running pid;
      if status <> WEXITED 0 then failed := (number, trial) :: !failed
  in
  let start number trial =
    if Hashtbl.length running >= at_once then wait ();
    let judge () =
      match Trial.run trial ~ports ~number with
      | Ok () -> 0
      | Error why -> Format.eprintf "%a:@.%s@." Trial.pp trial why; 1
    in
    Hashtbl.replace running (Processes.fork judge) (number, trial)
  in
  List.iteri start trials;
  while Hashtbl.length running > 0 do wait () done;
  !failed

(* Processes that take time from all others. *)
let burden n f =
  let rec burn () = if Sys.opaque_identity true then burn () else 0 in
  let burners = List.init n (fun _ -> Processes.fork ~patience:0 burn) in
  Fun.protect ~finally:(fun () -> List.iter Processes.stop burners) f

let run ?(load = 0) ?(is_losing = false) how_many =
  let ports = Test_support.Ports.lease () in
  let lines = Trial.lines ~ports in
  let trials = if is_losing then all_losing lines else all lines in
  let trials = match how_many with Some n -> sample n trials | None -> trials in
  let began = Unix.gettimeofday () in
  let failed = burden load (fun () -> run_all ~ports trials) in
  let summary =
    Printf.sprintf "%d consoles killed, of a journal of %d lines: %d resumed rightly, %d not; %.0f s"
      (List.length trials) lines
      (List.length trials - List.length failed)
      (List.length failed)
      (Unix.gettimeofday () -. began)
  in
  if failed = [] then Ok summary else Error summary
