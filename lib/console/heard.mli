(** The vehicles of a network that are heard while no run goes on. The platforms are open for that time only, and no
    vehicle is commanded. *)

type t

val make : Dolphin_app.Networks.choice -> changed:(unit -> unit) -> t
(** [make choice ~changed] listens from now on. [changed] is called when {!to_json} has changed, at most once a
    second. *)

val leave : t -> unit Lwt.t
(** Resolves once the platforms are closed, or do not close within {!patience}: a run may then open them. *)

val listen : t -> unit
(** Listens again after {!leave}: nothing of before is known any more. *)

val patience : float
(** 5 seconds. *)

val to_json : t -> Yojson.Safe.t
(** The [time], in seconds, the [vehicles], as lines of journals with the times when they were heard, and the [error]
    by which a platform cannot be opened, or [null]. *)
