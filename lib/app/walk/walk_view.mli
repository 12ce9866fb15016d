(** The display of a walk, as lines for a terminal. *)

type t = { program : Program_file.t; columns : int  (** of the terminal *) }

val state : t -> Manual_run.t -> string list
(** [state v r] is the present state of [r]: A, B, N, the rest of the task, the awaited events, the lost vehicles. *)

val variables : t -> Manual_run.t -> string list
(** Its global variables. *)

val choice : t -> int -> is_next:bool -> Manual_run.t -> Manual_run.choice -> string list
(** [choice v n ~is_next r x] is the choice [x] of [r] under the number [n], with a mark if [is_next]. *)

val run : t -> Manual_run.t -> string list
(** The steps so far, as a table. *)

val wrapped : columns:int -> head:string -> string -> string list
(** [wrapped ~columns ~head text] is [head] and [text] in lines of at most [columns] characters, cut between words where
    that can be; further lines begin below [text]. *)
