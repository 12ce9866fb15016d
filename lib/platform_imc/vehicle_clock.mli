(** The clock of a vehicle, as far as its datagrams show it: the order of sending of two of them, and its present time.

    Vehicles stamp each packet with their own time (header, [timestamp], s). That clock may differ from ours, run at
    another rate (simulated vehicles), and be set. Datagrams come late and out of order. *)

type t

val unknown : t
(** Nothing came of the vehicle so far. *)

val observe : now:float -> sent:float -> t -> t * float
(** [observe ~now ~sent c] is the knowledge after a datagram that is stamped [sent] came at our time [now] (s), and
    the stamp as the clock would have made it had it never been set back: of two datagrams the one with the greater
    stamp was sent later. A stamp more than {!tolerance} older than the latest is taken for that of a clock which was
    set back; an older one within the tolerance for that of a datagram which was overtaken. A stamp that is not a
    number up to {!greatest}, or more than {!farthest} behind or {!leap} ahead of the clock's expected time, is not
    taken: its datagram counts as sent with the latest. But if {!persistence} such stamps in a row fit one clock, the
    vehicle's was set. *)

val strays : t -> int
(** How many stamps were not taken that are more than {!farthest} away, or not numbers up to {!greatest}. *)

val latest : t -> float
(** The greatest stamp so far; [neg_infinity] before the first. *)

val estimate : now:float -> t -> float
(** [estimate ~now c] is the vehicle's clock at [now], by the least delayed datagram of the last {!window} to twice
    that: too early by that datagram's delay. [neg_infinity] if nothing came so far. *)

val tolerance : float
(** 30 s. *)

val window : float
(** 10 s. *)

val farthest : float
(** 86400 s: a day. *)

val greatest : float
(** 1e11 s. *)

val leap : float
(** 5 s: delays make stamps look older, never newer. *)

val persistence : int
(** 5. *)
