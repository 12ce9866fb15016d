(** How [dolphin] ends. *)

type t =
  | Done
  | Failed  (** the program halted, failed or got stuck *)
  | Violated  (** a run breaks what was asked of all *)
  | Bad_input  (** a bad program, fleet or command line *)
  | Platform_trouble
  | Inconclusive  (** a bound was met before an answer was found *)
  | Bug  (** a fault of [dolphin] itself *)
  | Interrupted

val of_verdict : Dolphin_checker.Verdict.t -> t

val code : t -> int
(** The number that a shell sees. *)

val exit_interrupted : unit -> unit
(** Ends the process at once, with the status {!Interrupted}: for handlers of signals. *)

val info : t list -> Cmdliner.Cmd.Exit.info list
(** For manual pages. *)
