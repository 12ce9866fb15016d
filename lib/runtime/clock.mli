(** The clocks that a platform reads: the time that has passed, and the date. They are arguments of their users, so
    that tests can set them. *)

type t = {
  elapsed : unit -> float;
  (** Seconds since some moment. It never goes back, and is not set: durations are differences of it. *)
  date : unit -> float;
  (** Seconds since 1970-01-01 00:00 UTC. It jumps, forward or back, when the system's time is set: it gives dates,
      never durations. *)
}

val system : t
(** The clocks of this machine: the monotonic one, and the time of day. *)

val stopwatch : ?at:float -> t -> unit -> float
(** [stopwatch ~at c] is a clock in seconds that starts now, at [at] (by default 0), and never goes back. *)
