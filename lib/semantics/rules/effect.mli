(** The requests of a transition to the outside: the driver carries them out. *)

open Core

type t =
  | Start of vehicle * platform_task
  | Stop of vehicle  (** whatever it runs for the program *)
  | Set_timer of Residual.timer * float  (** to expire after this number of seconds *)
  | Cancel_timer of Residual.timer
  | Put_question of Residual.timer * string  (** to people: yes or no; the program goes on meanwhile *)
  | Withdraw_question of Residual.timer
  | Look_for of Settings.pick
  (** vehicles are looked for; the script's timer is to expire after the pick's timeout, or without one after the
      platform's announce period *)
  | Bind of vehicle list
  | Release of vehicle list
  | Set_connection_timeout of vehicle list option * float  (** for these vehicles, or for all; seconds *)
  | Say of string
  | Ask of string
  | Call_host of { subject : string option; member : string; arguments : value list option }
  | End of Configuration.ending  (** the last effect of a run *)

val begins : Residual.timer * Residual.wait -> t
(** [begins (i, w)] sets the timer [i], or puts the question [i]. *)

val ceases : Residual.timer * Residual.wait -> t
(** [ceases (i, w)] cancels it, or withdraws it. *)

val pp : Format.formatter -> t -> unit
(** ["start survey on noptilus-1"], ["set timer 2 to 10 s"]. *)
