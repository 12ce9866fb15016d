(** Which vehicles a [pick] or a [recruit] may have. *)

open Core

val vehicles : World.t -> Shared.t -> Vehicle_filter.t -> (vehicle list, World.question) result
(** [vehicles w s q] is fit(q, w, B): those of [w] that are connected and ready, are not in B and have what [q] asks
    for, in the order of [w]; or what is to be known of [w] first. *)

val wherever : World.t -> Shared.t -> Vehicle_filter.t -> vehicle list
(** [wherever w s q] is [vehicles w s q] for a [q] that asks for no place. *)

val fits : World.t -> Shared.t -> Vehicle_filter.t -> vehicle -> (bool, World.question) result
(** [fits w s q v] is whether [v] is of [vehicles w s q]. *)
