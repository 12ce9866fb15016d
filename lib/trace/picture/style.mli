(** How pictures look: in light, in dark, on paper. *)

val sheet : string
(** The style sheet. Classes: [paper], [title], [small], [axis], [grid], [frame], [halo]; [v0] to [v7] for what belongs
    to a vehicle, with [bar], [track], [dot], [name]; [post], [consume], [say], [ask], [error], [silent], [held],
    [guide]; [bar open] for when something may be so; [limit] and [limit late] for a time that matters to all. *)

val colours : int
(** How many colours there are: 8. *)

val vehicle : int -> string
(** [vehicle i] is the class of the [i]-th vehicle, ["v3"]. *)
