(** What is ordered of an adapter and concluded from its reports, without a process. *)
