(** The version of this program, as dune-project has it. *)

val number : string
