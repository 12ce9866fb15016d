(** Ctrl-C, and whatever else asks a run to end: once in good order, twice at once. *)

type t

val make : ?last_words:string -> unit -> t
(** From now on SIGINT, SIGTERM and SIGHUP interrupt; the second one ends the process with
    {!Exit_status.Interrupted}, after it has complained with [last_words]. Under nohup SIGHUP stays ignored. *)

val interrupt : t -> unit
(** As a first Ctrl-C does. *)

val promise : t -> unit Lwt.t
(** Resolves at the first interruption. *)

val happened : t -> bool
(** Whether there was an interruption so far. *)
