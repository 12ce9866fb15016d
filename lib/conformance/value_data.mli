(** Values and tasks, written down whole: closures by the number of their code and their captured values. *)

open Dolphin_semantics

(** {1:write Writing} *)

val of_value : Data.budget -> Core.value -> Data.json
(** @raise Data.Too_large as {!Data.part} does; so do the others. *)

val of_closure : Data.budget -> Core.closure -> Data.json
(** The number of its lambda, and the values that it captured. *)

val of_platform_task : Data.budget -> Core.platform_task -> Data.json
val of_duration : Data.budget -> Core.duration -> Data.json
val of_task : Data.budget -> Core.task -> Data.json

val of_filter : Data.budget -> Vehicle_filter.t -> Data.json
(** The conditions of a [recruit] on a vehicle. *)

(** {1:read Reading}

    @raise Data.Wrong if this program has no such part. *)

val value : Nodes.t -> Data.json -> Core.value
val closure : Nodes.t -> Data.json -> Core.closure
val platform_task : Nodes.t -> Data.json -> Core.platform_task
val duration : Nodes.t -> Data.json -> Core.duration
val task : Nodes.t -> Data.json -> Core.task
val filter : Nodes.t -> Data.json -> Vehicle_filter.t
