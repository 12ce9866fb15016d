(** What [dolphin tla] makes of a program, as the constants of the specification. *)

val specification : (string * string) list
(** The modules of [spec/]: names of files, and texts. *)

val constants : Case.t -> (Family.constant list, string) result
(** All constants of the specification for this program in its world, or why it cannot be translated. *)
