(* Only types: the name of one that is counted. *)

type task = Idle | Platform of string | Sequence of task * task
