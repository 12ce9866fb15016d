(** A vehicle as [docs/imc.md] says that DUNE behaves, for tests of {!Dolphin_platform_imc.Execution}. *)

open Dolphin_imc

(** What becomes of a plan. *)
type fate =
  | Succeeds of float
  | Fails of float  (** after so many seconds *)
  | Is_refused of string
  | Is_lost of float * float
  (** After so many seconds the plan engine loses the plan: BLOCKED, while the vehicle maneuvers on for so long. *)

type t

val create : fate:(string -> fate) -> before:Message.Plan_control_state.t -> t
(** It said [before] last; if it was EXECUTING that plan, it goes on for ever. *)

val request : now:float -> copy:int -> Message.t Message.Plan_control.t -> t -> Message.t list
(** A request came, the [copy]th that was sent: what the vehicle sends at once. *)

val abort : t -> Message.t list
(** An Abort came: it rests. *)

val tick : now:float -> t -> Message.t list
(** Time has passed: what it sends. *)

val maneuvers : t -> bool
(** Whether the vehicle moves, for whatever its plan engine says. *)

val state : t -> Message.Plan_control_state.t

(** One execution of a plan. *)
type execution = { plan : string; request : int; copy : int; mutable succeeded : bool }

val executions : t -> execution list
(** Latest first. *)
