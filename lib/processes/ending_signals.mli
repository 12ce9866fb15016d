(** Signals that end a process unless it handles them, and that another process, a timer or a limit may send: all but
    SIGKILL, SIGHUP, SIGPIPE, and those of faults of the process itself (SIGSEGV and the like). *)

val requests : int list
(** Those by which people and systems end programs: SIGINT, SIGTERM, SIGQUIT. *)

val others : int list
(** SIGUSR1, SIGUSR2, those of timers (SIGALRM, SIGPROF), of limits (SIGXCPU, SIGXFSZ), SIGPOLL, and on Linux SIGSTKFLT,
    SIGPWR and the real-time signals. SIGVTALRM is the thread library's own, which lets other threads run at it. *)
