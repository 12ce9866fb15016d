(** Residuals and the script's machine, written down whole: code is named by its place in the core program. *)

open Dolphin_semantics

val of_control : Data.budget -> Configuration.control -> Data.json
(** @raise Data.Too_large as {!Data.part} does. *)

val control : Nodes.t -> Data.json -> Configuration.control
(** @raise Data.Wrong if this program has no such control. *)

(** {1:parts Their parts} *)

val of_machine : Data.budget -> Machine.t -> Data.json
(** @raise Data.Too_large, as {!of_residual} does. *)

val machine : Nodes.t -> Data.json -> Machine.t
(** @raise Data.Wrong, as {!residual} does. *)

val of_residual : Data.budget -> Residual.t -> Data.json
(** @raise Data.Too_large as {!Data.part} does. *)

val residual : Nodes.t -> Data.json -> Residual.t
(** @raise Data.Wrong if this program has no such residual. *)
