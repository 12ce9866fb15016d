(** Values and tasks, written down whole: closures by the number of their code and their captured values. *)

open Dolphin_semantics

(** {1:write Writing} *)

val of_value : Data.budget -> Core.value -> Data.json
(** @raise Data.Too_large as {!Data.part} does; so do the others. *)

val of_closure : Data.budget -> Core.closure -> Data.json
(** The number of its lambda, and the values that it captured. *)

val of_platform_task : Data.budget -> Core.platform_task -> Data.json
(** The plan's name, its place in the program, and the plan itself if it is inline. *)

val of_duration : Data.budget -> Core.duration -> Data.json
(** The seconds, or the code that gives them. *)

val of_task : Data.budget -> Core.task -> Data.json
(** The task term, with its code. *)

val of_ensured : Data.budget -> Core.ensured -> Data.json
(** A deed of the end of a task. *)

val of_filter : Data.budget -> Vehicle_filter.t -> Data.json
(** The conditions of a [recruit] on a vehicle. *)

(** {1:read Reading}

    @raise Data.Wrong if this program has no such part. *)

val value : Nodes.t -> Data.json -> Core.value
(** Reads what {!of_value} writes. *)

val closure : Nodes.t -> Data.json -> Core.closure
(** Reads what {!of_closure} writes. *)

val platform_task : Nodes.t -> Data.json -> Core.platform_task
(** Reads what {!of_platform_task} writes. *)

val duration : Nodes.t -> Data.json -> Core.duration
(** Reads what {!of_duration} writes. *)

val task : Nodes.t -> Data.json -> Core.task
(** Reads what {!of_task} writes. *)

val ensured : Nodes.t -> Data.json -> Core.ensured
(** Reads what {!of_ensured} writes. *)

val filter : Nodes.t -> Data.json -> Vehicle_filter.t
(** Reads what {!of_filter} writes. *)
