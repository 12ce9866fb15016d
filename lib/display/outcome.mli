(** What became of a run, in a few lines: for its end. *)

open Dolphin_semantics

type t

val start : t
val transition : t -> time:float -> Transition.t -> t

val lines : t -> now:float -> journal:string option -> colour:bool -> string list
(** [lines o ~now ~journal ~colour] says how the run ended and when, how many tasks it had and what became of them,
    which ones failed and why, and where its journal is. Empty while it has not ended. *)
