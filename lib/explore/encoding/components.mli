(** The components of executing tasks ({!Component}), each known by a small number, with their local steps, which are
    compiled once. *)

open Dolphin_semantics
open Dolphin_environment

type t

val create : ?foreseen:int -> Dolphin_checker.Numbering.t -> Environment.options -> Core.program -> World.t -> t
(** [foreseen] members of a new family are compiled in advance, so that layouts are seldom outgrown: 2,048 by
    default. *)

val options : t -> Environment.options
(** The environment of {!create}. *)

val program : t -> Core.program
(** The program of {!create}. *)

val world : t -> World.t
(** The world of {!create}. *)

val dismisses : t -> bool
(** Whether some handler may dismiss vehicles: its effect then depends on all vehicles needed around it. *)

val coverage : t -> Coverage.t
(** The code that was reached so far. *)

(** {1:components Components} *)

val children : t -> Component.path -> Residual.t -> Component.component Component.tree list
(** [children t p r] is the list of parts of [r], at [p]. *)

val goes_round : t -> bool
(** Whether some step that was worked out begins a round of a [repeat] without a number of rounds: only then may there
    be cycles while a task executes. *)

val set_goes_round : t -> unit
(** Another process has worked out such a step. *)

val note_rounds : t -> Dolphin_semantics.Task_rules.round list -> unit
(** [note_rounds t rs] notes that a step begins [rs]. *)

val root : t -> Component.path
(** The path of whole tasks: the one that no nest is around. *)

val reach : t -> Component.component -> unit
(** [reach t p] compiles the steps of [p], which some run reaches. *)

val footprints : t -> makes:bool -> Component.component -> Step_footprints.t
(** [footprints t ~makes p] is the footprints of the steps of [p], in their order; [makes] is whether tasks are made
    at their turn somewhere in the layout. *)

(** {1:nests Nests} *)

val in_contexts : t -> Component.path -> Residual.context list -> Component.path
(** [in_contexts t p ks] is the place of components inside the contexts [ks], the innermost first, at [p]. *)

val cuts : t -> Component.path -> Component.step array
(** [cuts t p] is the steps of the contexts of nests whose inside is at [p], which some run reaches. *)

val cut_footprints : t -> makes:bool -> Component.path -> Step_footprints.t
(** [cut_footprints t ~makes p] is the footprints of these steps, in their order. *)

val escaping : ?owed:Component.owed -> Component.step -> Task_rules.step
(** [escaping ?owed s] is [s] as a step of the whole task, as far as errors go ({!Task_rules.escaping}), and what they
    cut off ensures: nothing by default. *)

val ensures : t -> bool
(** Whether some task of the program may have an [ensure]. *)

val alone : t -> Component.component -> Component.target
(** [alone t p] is the result of the nest around [p] when nothing else is left in it. *)

val around : Component.path -> Residual.t -> Residual.t
(** [around p r] is [r] in the contexts of the nest whose inside is at [p], which is not the root. *)

val outside : Component.path -> Component.path
(** [outside p] is the place of that nest. *)

val landed : t -> Component.step -> int -> Residual.t -> Component.target
(** [landed t s n r] is the target of step [s] if [r] takes the place of the nest that is [n] levels above what [s]
    belongs to; 0 is the level of that itself. *)

(** {1:families Widths of families} *)

val lay_out : Component.family -> unit
(** [lay_out f] makes [f] as wide as its members need. *)

val numbering : t -> Dolphin_checker.Numbering.t
(** The numberings of {!create}. *)

val outgrown : t -> bool
(** Whether a family has outgrown its width since it was laid out. *)

val none_outgrown : t -> unit
(** All families have been laid out again. *)
