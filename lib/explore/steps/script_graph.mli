(** Which place of the script follows which: the configurations that execute nothing, and the machines that wait for a
    task. A state graph has no cycle if these have none, since an executing task only gets less. *)

type t

val create : unit -> t
(** No place follows another. *)

val follows : t -> int -> int -> unit
(** [follows t p p'] notes that [p'] comes after [p], by numbers. *)

val edges : t -> (int * int) list
(** All that was noted, the latest first. *)

val may_cycle : t -> bool
(** Whether some place comes after itself. *)
