(** The terminal that a board stands on. *)

val is_live : unit -> bool
(** Whether standard output is a terminal on which lines can be redrawn. *)

val size : Unix.file_descr -> int * int
(** [size fd] is the rows and columns of the terminal [fd], 24 and 80 if it does not report them. *)

val is_ours : Unix.file_descr -> bool
(** [is_ours fd] is whether this process may use the terminal [fd] now: a job in the background may not. *)

(** {1 What is typed} *)

type quiet
(** A terminal that does not show what is typed, which would otherwise move the board. *)

val hush : unit -> quiet option
(** [hush ()] keeps standard input from showing what is typed, if it is a terminal, and ours. *)

val unhush : quiet -> unit
(** Typed text is shown again; text typed meanwhile is dropped: it was not meant for the next question. *)
