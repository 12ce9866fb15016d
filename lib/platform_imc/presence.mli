(** When a console makes itself known: its announcements, to all listeners, and its heartbeats to vehicles. Times are
    seconds of our clock. *)

type t

val start : t
(** An announcement and heartbeats are due. *)

val met : now:float -> t -> t * bool
(** [met ~now p] is [p] after a system was met that is new, or that can be reached elsewhere, and whether to announce
    ourselves now. *)

val announce : now:float -> awaited:bool -> t -> t * bool
(** [announce ~now ~awaited p] is whether an announcement is due. [awaited]: a vehicle has announced itself and not yet
    spoken to us; it may have missed our announcement. *)

(** The receivers of heartbeats. *)
type heartbeats = All | Awaited  (** only vehicles that have not spoken to us yet *) | Nobody

val beat : now:float -> awaited:bool -> t -> t * heartbeats
(** [beat ~now ~awaited p] is the heartbeats that are due; [awaited]: some are to follow soon. *)

val hasten : at:float -> t -> t
(** [hasten ~at p]: eager heartbeats are due at [at], if not before. *)

val due : t -> float
(** When something is due next. *)

(** {1:constants Constants} Seconds. *)

val announce_interval : float
(** 10: the time between two announcements. *)

val eager_announce_interval : float
(** 1: the same while a vehicle that has announced itself has not spoken to this console yet. *)

val heartbeat_interval : float
(** 1: the time between two heartbeats to all vehicles. *)

val eager_heartbeat_interval : float
(** See {!Station}. *)
