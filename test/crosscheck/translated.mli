(** The output of [dolphin tla] for a program, as the constants of the specification. *)

val specification : (string * string) list
(** The modules of [spec/]: names of files, and texts. *)

val model : ?times:Dolphin_tla.Times.t -> Case.t -> (Dolphin_tla.Model.file list, string) result
(** The model of this program in its world, with its times if there are any, or why it cannot be translated. *)

val constants : Case.t -> (Family.constant list, string) result
(** All constants of the specification for this program in its world, or why it cannot be translated. *)

val timed_constants : Dolphin_tla.Times.t -> Case.t -> (Family.constant list, string) result
(** The same, with those of [Timed.tla]. *)
