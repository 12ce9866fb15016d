(** Operations on values: operators, elements, methods, blocks of settings, procedures. *)

open Core

val apply : Code.context -> site -> operation -> value list -> Code.outcome
(** [apply context site operation arguments] is the result of [operation], at [site]. *)
