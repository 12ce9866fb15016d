(** Models in directories, and TLC at work on them. *)

open Dolphin_tlc

type model = (string * string) list
(** Files: name and contents. *)

val installation : string option -> (Installation.t, Exit_status.t) result
(** [installation jar] is where Java and TLC are, or it has been told on standard error what is missing. *)

val write : directory:string -> model -> (unit, Exit_status.t) result
(** [write ~directory m] writes the files of [m], making the directory if there is none. *)

val in_directory : string option -> model -> (string -> Exit_status.t) -> Exit_status.t
(** [in_directory directory m f] is [f d] where [d] is a directory with the files of [m]: the one that is given, or one
    that is gone afterwards. *)

type ended = Ended of Outcome.t | Interrupted of Outcome.t  (** by a signal, before its end *)

val run : Installation.t -> Invocation.mode -> directory:string -> main:string -> configuration:string ->
  (string -> unit) -> (ended, Exit_status.t) result
(** [run i m ~directory ~main ~configuration printed] runs TLC, showing its progress where standard error is a
    terminal; signals that ask to stop stop it. [printed] is called for each line that is not TLC's. If it failed, it
    has been told why. *)
