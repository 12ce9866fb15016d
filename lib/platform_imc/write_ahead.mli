(** A gate before the network that is shut until the disk has what was kept: of what is to be sent, nothing leaves
    before, and all leaves in order. Requests that come while the disk is at work wait for its next turn together. *)

type 'a t

val make :
  sync:(unit -> unit Lwt.t) -> leave:(string list -> 'a list -> unit) -> failed:(string list -> exn -> unit) -> 'a t
(** [make ~sync ~leave ~failed] is an open gate. [sync ()] resolves once the disk has all that was kept before. Then
    [leave vehicles messages] is to send these messages, in this order; for [vehicles] the gate was shut. If [sync]
    fails, [failed] is told instead, and the messages are dropped. *)

val shut : 'a t -> string -> unit
(** [shut g vehicle]: something was kept that the disk must have before a request to [vehicle] leaves. *)

val is_shut : 'a t -> bool

val hold : 'a t -> 'a -> unit
(** [hold g message] has it wait, behind those that wait already. To be used while {!is_shut}. *)
