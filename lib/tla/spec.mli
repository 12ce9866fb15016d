(** The texts of the specification's modules, as in [spec/]. Made by the build. *)

val dolphin : string
val machine : string
val values : string
