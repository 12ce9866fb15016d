(** Processes of the kill tests. None of them runs Lwt before it forks. *)

val fork : ?patience:int -> (unit -> int) -> int
(** [fork ~patience f] is the process that runs [f] and exits with the result of [f]; 125 if [f] raises. It ends by
    itself after [patience] seconds (15), if that is not 0. *)

val wait : int -> Unix.process_status
val stop : int -> unit
(** [stop pid] asks the process to end, and waits until it has. *)
