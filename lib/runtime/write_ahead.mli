(** Write-ahead: requests leave only once the disk has the notes that were kept before them. While the disk is at work,
    all messages wait, and then leave in order; notes that are kept meanwhile share the next sync (group commit). *)

type 'a t

val make :
  sync:(unit -> unit Lwt.t) -> leave:(string list -> 'a list -> unit) -> failed:(string list -> exn -> unit) -> 'a t
(** [make ~sync ~leave ~failed] waits for nothing. [sync ()] resolves once the disk has all that was kept before.
    Then [leave vehicles messages] is to send these messages, in this order; [vehicles] are those of the notes that
    are now durable. If [sync] fails, [failed] is called instead, and the messages are dropped. *)

val require : 'a t -> string -> unit
(** [require w vehicle]: a note was kept that must be durable before a request to [vehicle] leaves. *)

val is_waiting : 'a t -> bool
(** Whether messages wait for the disk now. *)

val enqueue : 'a t -> 'a -> unit
(** [enqueue w message] has it wait, behind those that wait already. To be used while {!is_waiting}. *)
