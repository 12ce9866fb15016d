(* Work shared among processes: its results, and its end. *)

module Limits = Dolphin_processes.Process_limits
module Workers = Dolphin_processes.Workers

let rec all workers found =
  if Workers.is_done workers then List.sort compare found
  else all workers (Workers.next workers ~timeout:1. @ found)

let results = Alcotest.(list (pair int int))
let square n = n * n

let with_workers ~jobs ~last f use =
  let workers = Workers.start ~jobs ~first:1 ~last f in
  Fun.protect ~finally:(fun () -> Workers.stop workers) (fun () -> use workers)

let check_none_left () =
  match Unix.waitpid [ WNOHANG ] (-1) with
  | _ -> Alcotest.fail "a process is left"
  | exception Unix.Unix_error (ECHILD, _, _) -> ()

let test_all jobs () =
  let squares = List.init 10 (fun i -> (i + 1, square (i + 1))) in
  with_workers ~jobs ~last:10 square (fun workers -> Alcotest.check results "squares" squares (all workers []));
  check_none_left ()

(* Results that do not fit into a pipe at once; the processes look whether this one lives while they wait for it. *)
let test_large () =
  let length workers =
    Unix.sleepf 0.7;
    List.map (fun (n, text) -> (n, String.length text)) (all workers []) in
  let lengths = with_workers ~jobs:2 ~last:3 (fun n -> String.make (n * 1_000_000) 'x') length in
  Alcotest.check results "lengths" [ (1, 1_000_000); (2, 2_000_000); (3, 3_000_000) ] lengths

let death ~jobs ~last f =
  match with_workers ~jobs ~last f (fun workers -> all workers []) with
  | _ -> Alcotest.fail "all is well"
  | exception Workers.Died { number; how } -> check_none_left (); (number, how)

let check_death = Alcotest.(check (pair int string)) "number, how"
let kill_at bad n = if n = bad then Unix.kill (Unix.getpid ()) Sys.sigkill; n
let test_killed () = check_death (3, "killed") (death ~jobs:2 ~last:4 (kill_at 3))
let test_exception () = check_death (2, "with status 1") (death ~jobs:1 ~last:2 (fun n -> if n = 2 then raise Exit; n))

(* Ctrl-C reaches all processes of a terminal; these leave it to the one that has made them. *)
let interrupt_oneself n = Unix.kill (Unix.getpid ()) Sys.sigint; n

let test_interrupted () =
  let found = with_workers ~jobs:1 ~last:1 interrupt_oneself (fun workers -> all workers []) in
  Alcotest.check results "as before" [ (1, 1) ] found

(* An unneeded process is ended in the midst of its work. *)
let rec for_ever n = Unix.sleepf 10.; for_ever n

let test_stop () =
  let none workers = Alcotest.check results "nothing yet" [] (Workers.next workers ~timeout:0.) in
  with_workers ~jobs:3 ~last:3 for_ever none;
  check_none_left ()

(* A process ends when the one dies that has made it: the writing end of a pipe that it has is closed then. *)
let test_orphan () =
  let input, output = Unix.pipe () in
  (match Unix.fork () with
   | 0 ->
     let (_ : int Workers.t) = Workers.start ~jobs:1 ~first:1 for_ever in
     Unix._exit 0
   | pid -> ignore (Unix.waitpid [] pid : int * Unix.process_status));
  Unix.close output;
  let is_closed = Unix.select [ input ] [] [] 60. <> ([], [], []) in
  Alcotest.(check bool) "it has ended" true (is_closed && Unix.read input (Bytes.create 1) 0 1 = 0)

(* The limit of a service, or of a shell, may be below that which the console gives to its workers. *)
let test_lower_limit () =
  let held _ =
    Limits.memory 1000;
    Limits.memory 2000;
    match Bytes.create 1_500_000_000 with _ -> "1.5 GB are there" | exception Out_of_memory -> "1 GB holds" in
  with_workers ~jobs:1 ~last:1 held (fun workers ->
      Alcotest.(check (list (pair int string))) "limit" [ (1, "1 GB holds") ] (all workers []))

let () =
  let case name f = Alcotest.test_case name `Quick f in
  Alcotest.run "workers"
    [ ("results", [ case "by one" (test_all 1); case "by three" (test_all 3); case "large" test_large ]);
      ("ends",
       [ case "killed" test_killed; case "an exception" test_exception; case "Ctrl-C" test_interrupted; case "stopped" test_stop;
         case "left alone" test_orphan; case "a lower limit" test_lower_limit ]) ]
