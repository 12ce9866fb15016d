(** The outcome of a run, in a few lines: for its end. *)

open Dolphin_semantics

type t

val start : t
(** No transition so far. *)

val transition : t -> time:float -> Transition.t -> t
(** [transition o ~time t] is [o] after [t], which was taken at [time]. *)

val lines : t -> now:float -> journal:string option -> colour:bool -> string list
(** [lines o ~now ~journal ~colour] states how the run ended and when, the number of its tasks and their outcomes,
    the failed ones with their reasons, and the place of its journal. Empty while it has not ended. *)
