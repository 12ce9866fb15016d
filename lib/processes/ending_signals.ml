let requests = [ Sys.sigint; Sys.sigterm; Sys.sigquit ]

(* Signals that {!Sys} has no name for, by their numbers on Linux: SIGSTKFLT, SIGPWR, SIGRTMIN to SIGRTMAX. *)
let unnamed = if Sys.file_exists "/proc/self/status" then 16 :: 30 :: List.init 31 (fun i -> 34 + i) else []

(* Not SIGVTALRM: the thread library records it for itself at each tick, to let other threads run, and handles it. *)
let others =
  [ Sys.sigusr1; Sys.sigusr2; Sys.sigalrm; Sys.sigprof; Sys.sigxcpu; Sys.sigxfsz; Sys.sigpoll ] @ unnamed
