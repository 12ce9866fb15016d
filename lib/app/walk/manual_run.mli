(** A run that is taken by hand: its past, its present state, and the steps ahead of it after going back, or when a
    recorded run is followed. Its steps are those of {!Dolphin_environment.Environment.choices}, and no others. *)

open Dolphin_semantics
open Dolphin_environment

(** The program, and what may happen to it. *)
type world = { program : Core.program; world : World.t; options : Environment.options }

type choice = Transition.t * Environment.t
(** A step, and the memory of the environment after it. *)

type t

val start : world -> t
(** The run without steps, and nothing ahead. *)

val configuration : t -> Configuration.t
(** The configuration now. *)

val outside : t -> Environment.t
(** The environment's memory now. *)

val length : t -> int
(** How many steps were taken. *)

val ahead : t -> choice list
(** The steps that {!next} takes, one after the other. *)

val steps : t -> Transition.t list
(** The steps that were taken, the first one first. *)

val choices : t -> choice Seq.t
(** The possible steps now, computed on demand.
    @raise Environment.Unclear each time it is gone through, if the steps cannot be listed. *)

val is_stuck : t -> bool
(** Whether nothing is owed in the state where the run is: {!Environment.is_stuck}.
    @raise Environment.Unclear as {!choices} *)

val is_next : t -> choice -> bool
(** [is_next r x] is whether [x] is the first step ahead. *)

(** {1:moves Moves} *)

val take : choice -> t -> t
(** [take x r] is [r] after [x], one of its {!choices}. The steps ahead stay if [x] is the first of them. *)

val undo : t -> t option
(** [undo r] is [r] without its latest step, which is ahead now. *)

val next : t -> t option
(** [next r] is [r] after the first step ahead. *)

val goto : int -> t -> t option
(** [goto n r] is [r] after [n] steps, back or ahead; [None] if there are fewer. *)

val recorded : Dolphin_trace.Witness.t -> t -> (t, string) result
(** [recorded w r] is the run without steps, with those of [w] and its cycle, once around, ahead; or which step of [w]
    cannot be taken, and why. *)
