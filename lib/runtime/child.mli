(** A child process that is spoken to through its standard input and output. Its standard error goes to ours, line by
    line, fit for a terminal. *)

type t

val start : environment:(string * string) list -> string -> (t, string) result
(** [start ~environment command] runs [command] with [/bin/sh], with [environment] added to ours. It leads a session
    of its own: the terminal's Ctrl-C is for Dolphin, which ends the child in good order. From then on SIGPIPE is
    ignored. The error is the reason why no process could be made. *)

val input : t -> Lwt_unix.file_descr
(** Our output to it. *)

val output : t -> Lwt_unix.file_descr
(** Our input from it. *)

val exited : t -> Unix.process_status Lwt.t
(** Resolves once the child has ended and is reaped; remaining processes of its session are killed then. May be
    cancelled, which means nothing. *)

val pp_status : Format.formatter -> Unix.process_status -> unit
(** ["ended with exit status 3"], ["was killed by SIGTERM"]. *)

val close : t -> unit Lwt.t
(** [close c] closes the child's input, and if the child does not end by itself within half a second terminates it, and
    a second later kills it. Resolves once it is reaped. May be called more than once. *)

val kill : t -> unit Lwt.t
(** [kill c] kills the child and all of its session's processes at once. Resolves once it is reaped. *)
