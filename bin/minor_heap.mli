(** A large minor heap for searches. Short commands do without: fresh pages would cost them a tenth of their time. *)

val enlarge : unit -> unit
(** Call it before the search, which may leave no memory for it. *)
