(** The {!Worker} processes of a console. They are started on need, and end after half a minute without work. A worker
    that takes too long, or dies, fails the request that it works on, and no other one. *)

open Exchange

type limits = {
  workers : int;  (** at once *)
  each : int;  (** tasks of one client at once *)
  waiting : int;  (** tasks that wait for their turn; one client may have half of them *)
  seconds : float;  (** for a task, or for each piece of one that streams *)
  megabytes : int;  (** memory of a worker *)
  reply : int;  (** bytes of a whole reply, or of one piece *)
}

val limits : limits
(** 3 workers, 2 tasks of each client, 20 that wait, 20 seconds, 2 GiB, 16 MiB. *)

type t

val make : dolphin:string -> limits -> t
(** [make ~dolphin limits]: workers are processes of the command [dolphin]. *)

val whole :
  t -> client:string -> Worker.order -> ?body:string -> unit -> (Dolphin_http.Response.t, refusal) result Lwt.t
(** [whole p ~client order ~body ()] is the reply of a worker. It is refused as ["too-many"] if no place is left,
    ["too-long"], ["too-large"], or ["worker-died"]. *)

val pieces : t -> client:string -> Worker.order -> (string -> unit Lwt.t) -> (unit, refusal) result Lwt.t
(** [pieces p ~client order write] gives the body of the reply to [write] as the worker sends it: the worker waits for
    [write]. If [write] fails, so does this, and the worker is killed. *)

val is_full : t -> string -> bool
(** [is_full p client] is whether a task of [client] would have to wait. *)

val pids : t -> int list
(** The processes that there are. *)

val close : t -> unit
(** Kills all of them. *)
