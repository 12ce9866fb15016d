(** What pages are told of a run, one message after the other, as server-sent events. They are kept on the disk, in a
    file without a name, and each reader reads them at its own pace: one that does not read costs no memory, and one
    that comes late or again misses nothing. *)

type t

val create : run:string -> t
(** [create ~run] has no messages yet. Their identities begin with [run]. May raise [Sys_error]. *)

val add : t -> event:string -> string -> unit
(** [add f ~event data] adds the message [data], one line, of kind [event]. *)

val read : t -> int -> string * int
(** [read f offset] is the next whole messages from [offset] on, some 64 KiB of them, and where they end. *)

val resumed : t -> string -> int
(** [resumed f id] is where a reader goes on that has read up to the message with the identity [id], and 0 if that is
    none of [f]'s. *)

val close : t -> unit
(** Its file is given up. *)
