(** Text that is written to a file descriptor, to a child process or a client, by whoever does not wait for it. *)

val write : Lwt_unix.file_descr -> string -> unit Lwt.t
(** [write output text] writes all of [text]. It fails with [Unix.Unix_error] if nobody can read it any more. *)

type t

val make : Lwt_unix.file_descr -> t

val send : t -> string -> unit
(** [send w text] has [text] written once all that was sent before is. What nobody reads any more is forgotten: that the
    other side is gone shows elsewhere. *)
