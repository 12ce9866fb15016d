(** The parts of executing tasks ({!Part}), each known by a small number, with their local steps worked out once. *)

open Dolphin_semantics

type t

val create : ?foreseen:int -> Environment.options -> Core.program -> World.t -> t
(** So many members of a new family are worked out in advance: layouts are then seldom outgrown. *)

val options : t -> Environment.options
val program : t -> Core.program
val world : t -> World.t
val coverage : t -> Coverage.t

(** {1:parts Parts} *)

val children : t -> Part.path -> Residual.t -> Part.part Part.tree list
(** [children t p r] is what [r], at [p], is made of. *)

val root : t -> Part.path

val reach : t -> Part.part -> unit
(** [reach t p] works out the steps of [p], which some run reaches. *)

val components : t -> Part.part -> Components.t
(** [components t p] is of the steps of [p], in their order. *)

(** {1:nests Nests} *)

val cuts : t -> Part.path -> Part.step array
(** [cuts t p] is the steps of the contexts of nests whose inside is at [p], which some run reaches. *)

val cuts_components : t -> Part.path -> Components.t
(** [cuts_components t p] is of these steps, in their order. *)

val alone : t -> Part.part -> Part.target
(** [alone t p] is what becomes of the nest around [p] when nothing else is left in it. *)

val around : Part.path -> Residual.t -> Residual.t
(** [around p r] is [r] in the contexts of the nest whose inside is at [p], which is not the root. *)

val outside : Part.path -> Part.path
(** [outside p] is where that nest stands. *)

val landed : t -> Part.step -> int -> Residual.t -> Part.target
(** [landed t s n r] is what becomes of the nest that is [n] levels above what [s] belongs to (0: of that itself) when
    [r] takes its place. *)

(** {1:families Widths of families} *)

val lay_out : Part.family -> unit
(** [lay_out f] makes [f] as wide as its members need. *)

val outgrown : t -> bool
(** Whether a family has outgrown its width since it was laid out. *)

val none_outgrown : t -> unit
(** All families have been laid out again. *)
