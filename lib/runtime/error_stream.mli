(** The standard error of child processes, on ours: without characters that could command the terminal, and in UTF-8
    ({!Dolphin_trace.Phrase.harmless}). *)

val pass_on : Lwt_unix.file_descr -> unit Lwt.t
(** [pass_on input] writes what comes from [input] to standard error, line by line, until it ends, and closes it then.
    Resolves once all of it is written. A carriage return ends a line. While standard error takes nothing, 16 MiB wait,
    and [input] is read on; the bytes that come then are dropped, and counted in a line. *)
