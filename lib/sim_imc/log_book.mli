(** The entries of a vehicle in its log book about plans, as measured with DUNE 2026.01. It sends each line to all
    listeners. *)

open Dolphin_imc

type line
(** An entry, without its time. *)

val entity : line -> int
(** The author of the entry. *)

val to_message : time:float -> line -> Message.t
(** [to_message ~time l] is [l], written at [time], in seconds since 1970. *)

(** {1:engine The plan engine} *)

val engine : int
(** Its entity: 55. *)

val start_requested : plan:string -> line
(** A START of [plan] came. *)

val stop_requested : plan:string -> line
(** A STOP of [plan] came. *)

val initializing : plan:string -> line
(** [plan] is being initialised. *)

val executing : maneuver:string -> line
(** A maneuver begins, each of a plan's. *)

val answered : ?error:bool -> request:[ `Start | `Stop ] -> plan:string -> string -> line
(** [answered ~request ~plan info] is the reply with [info] to a request, as an error if it is one (not at first). *)

val refused : why:string -> line
(** The entry after the answer to a START that is refused: whether the plan could not be loaded or not be read. *)

val completed : line
(** The plan was carried out. *)

val stopped : line
(** The plan was stopped. *)

val ready : line
(** The engine takes plans again after it was BLOCKED. *)

(** {1:others Others} *)

val supervisor : int
(** The entity of the vehicle's supervisor: 75. *)

val mode : Message.Vehicle_state.Op_mode.t -> line
(** The vehicle is now in this mode. *)

val aborted : why:string -> line
(** The vehicle aborts, for this reason. *)

val database : int
(** The entity of the plan database: 54. *)

val storing : plan:string -> line
(** A plan came with a START. *)

val stored : plan:string -> info:string -> line
(** A plan was stored in the database. *)
