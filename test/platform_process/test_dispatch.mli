(** Orders to an adapter and conclusions from its reports, without a process. *)
