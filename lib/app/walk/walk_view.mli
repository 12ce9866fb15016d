(** What a walk shows, as lines for a terminal. *)

type t = { program : Program_file.t; columns : int  (** of the terminal *) }

val state : t -> Course.t -> string list
(** [state v r] is the state that [r] is in: A, B, N, what is left of the task, what is waited for, which vehicles are
    lost. *)

val variables : t -> Course.t -> string list
(** Its global variables. *)

val choice : t -> int -> is_next:bool -> Course.t -> Course.choice -> string list
(** [choice v n ~is_next r x] is the choice [x] of [r] under the number [n], with a mark if [is_next]. *)

val run : t -> Course.t -> string list
(** The steps so far, as a table. *)

val wrapped : columns:int -> head:string -> string -> string list
(** [wrapped ~columns ~head text] is [head] and [text] in lines of at most [columns] characters, cut between words where
    that can be; further lines begin below [text]. *)
