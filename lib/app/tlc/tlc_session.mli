(** Models in directories, and TLC at work on them. *)

open Dolphin_tlc

type model = (string * string) list
(** Files: name and contents. *)

val installation : string option -> (Installation.t, Error.t) result
(** [installation jar] is the places of Java and TLC; the error, {!Error.Unavailable}, names the missing one. *)

val write : directory:string -> model -> (unit, Error.t) result
(** [write ~directory m] writes the files of [m], all or none, and makes the directory if necessary. *)

val in_directory : string option -> model -> (string -> ('a, Error.t) result) -> ('a, Error.t) result
(** [in_directory directory m f] is [f d] where [d] is a directory with the files of [m]: the one that is given, or a
    temporary one, which is removed afterwards. *)

(** What TLC found until it ended or was stopped. *)
type ended = Ended of Outcome.t | Interrupted of Outcome.t  (** by a signal, before its end *)

val run : Installation.t -> Invocation.mode -> directory:string -> main:string -> configuration:string ->
  (string -> unit) -> (ended, Error.t) result
(** [run i m ~directory ~main ~configuration printed] runs TLC, showing its progress where standard error is a
    terminal; signals that ask to stop stop it. [printed] is called for each line that is not TLC's. The error is
    {!Error.Inconclusive} if TLC gave up, and else {!Error.Unavailable}. *)
