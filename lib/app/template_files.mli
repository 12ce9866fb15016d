(** The files of [templates/mission], as texts: the build makes this module of them. *)

val program : string
val fleet : string
val readme : string
val check : string
val workflow : string
