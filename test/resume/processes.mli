(** Processes of the kill tests. None of them runs Lwt before it forks. *)

val fork : (unit -> int) -> int
(** [fork f] is the process that runs [f] and exits with what [f] returns; 125 if [f] raises. It ends by itself after a
    minute. *)

val wait : int -> Unix.process_status
val stop : int -> unit
(** [stop pid] asks the process to end, and waits until it has. *)
