(** A roomy nursery (minor heap) for searches. A short command is a tenth faster without: it would spend that on
    pages that are new. *)

val make_room : unit -> unit
(** To be called before the search, which may leave no memory for it. *)
