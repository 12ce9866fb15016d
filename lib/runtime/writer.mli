(** Text that is written to a file descriptor, to a child process or a client, by code that does not wait for it. *)

val write : Lwt_unix.file_descr -> string -> unit Lwt.t
(** [write output text] writes all of [text]. It fails with [Unix.Unix_error] if its reader has gone. *)

type t

val make : Lwt_unix.file_descr -> t
(** [make fd] writes to [fd], to which nothing else writes. *)

val send : t -> string -> unit
(** [send w text] has [text] written once all that was sent before is. Text without a reader is dropped: other code
    notices that the other side is gone. *)

val sent : t -> unit Lwt.t
(** Resolves once all that was sent so far is written, or dropped. *)
