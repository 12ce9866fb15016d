(** Text files. *)

val read : string -> (string, Error.t) result
(** [read path] is the contents of the file [path], at most 64 MB. The error, {!Error.Bad_input}, names the file. *)

val anything : string -> (unit, string) result
(** That any file may be read. *)

val read_named : may_read:(string -> (unit, string) result) -> string -> (string, string) result
(** [read_named ~may_read path] is {!read} of a file that a text names, if [may_read path] lets it; or why not, in
    words. *)

val read_input : unit -> (string, Error.t) result
(** [read_input ()] is the text of standard input up to its end, at most 64 MB. *)

val named : string -> string -> string
(** [named path why] is the reason [why] of a [Sys_error], with the name of the file, [path], before it if it lacks it:
    some have it. *)

val with_channel : string -> (in_channel -> ('a, Error.t) result) -> ('a, Error.t) result
(** [with_channel path f] is [f] of the file [path], open for reading, in binary. A [Sys_error] of [f] is an error, as
    not to be able to open the file is: {!Error.Bad_input}. *)

val check : string -> (unit, Error.t) result
(** [check path] fails with {!Error.Unavailable} if it is clear already that {!write} will. It writes nothing. *)

val write : string -> (out_channel -> unit) -> (unit, Error.t) result
(** [write path f] replaces the file [path], if it exists, by the output of [f], and only when all is written: a
    failure leaves it as it was. Devices and pipes are written to directly. The error is {!Error.Unavailable}. *)

type file = {
  name : string;  (** below the folder; it may begin with the names of folders in it *)
  text : string;
  is_command : bool;  (** users who may read it may run it *)
}
(** One of several files that are written together. *)

val write_all : string -> file list -> (unit, Error.t) result
(** [write_all folder files] writes the files into [folder], and makes the folders that are missing, but only when the
    text of all is written: a failure before leaves neither files nor folders, and the files that were there as they
    were. The error, {!Error.Unavailable}, names a file or folder. *)
