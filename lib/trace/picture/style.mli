(** How pictures look: in light, in dark, on paper. *)

val sheet : string
(** The style sheet. Classes: [paper], [title], [small], [axis], [grid], [frame], [halo]; [v0] to [v7] for elements
    of a vehicle, with [bar], [track], [dot], [name]; [post], [consume], [say], [ask], [error], [silent], [held],
    [guide]; [bar open] for an uncertain interval; [limit] and [limit late] for a time that matters to all. *)

val colours : int
(** How many colours there are: 8. *)

val colour : int -> string
(** [colour i] is that of the [i]-th vehicle, on light ground. *)

val vehicle : int -> string
(** [vehicle i] is the class of the [i]-th vehicle, ["v3"]. *)

val group : int -> Svg.t list -> Svg.t
(** [group i ts] is [ts] together, which show the [i]-th vehicle: of the classes [who] and ["w3"]. *)
