(** The clocks that a platform reads: how much time has passed, and what date it is. They are arguments of whoever needs
    them, so that tests can set them. *)

type t = {
  elapsed : unit -> float;
  (** Seconds since some moment. It never goes back, and nobody sets it: durations are differences of it. *)
  date : unit -> float;
  (** Seconds since 1970-01-01 00:00 UTC. It jumps, forward or back, when somebody sets the system's time: it tells
      dates, never durations. *)
}

val system : t
(** The clocks of this machine: the monotonic one, and the time of day. *)

val stopwatch : ?at:float -> t -> unit -> float
(** [stopwatch ~at c] is a clock in seconds that starts now, at [at] (by default 0), and never goes back. *)
