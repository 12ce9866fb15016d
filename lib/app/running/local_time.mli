(** The clock of the machine. *)

val zone : float -> int
(** [zone s] is the offset of its local zone from UTC at the time [s], in minutes; [s] is as [Unix.gettimeofday] has
    it. *)

val now : int option -> Dolphin_semantics.Calendar.t
(** [now z] is the date now in zone [z], by default the local one. *)
