(** Journals, from their files, line by line. *)

open Dolphin_trace

val with_reader : string -> (Journal.t -> ('a, Error.t) result) -> ('a, Error.t) result
(** [with_reader path f] is [f] of the journal in the file [path]; ["-"] is standard input. *)

val iter : (Entry.t -> unit) -> string -> (unit, Error.t) result
(** [iter f path] gives each line of the journal [path] to [f]. The last line may be torn. The error,
    {!Error.Bad_input}, is the first line that is not a line of a journal. *)

val wrong : string -> number:int -> string -> Error.t
(** [wrong path ~number why] is {!Error.Bad_input}: [why] line [number] of [path] is not a line of a journal. *)

val program : string -> Header.source option
(** [program path] is the program that the run of the journal in the file [path] had last: that of its latest line
    [resumed], or else of its header; [None] if it has no header, or cannot be read. It reads all lines, and parses
    few. *)

val settings_of : Journal.t -> (string * string) list option
(** [settings_of reader] is the parameters that the run was started with, of a journal of which nothing was read yet;
    [None] if it has no header. *)

val settings : string -> (string * string) list option
(** [settings path] is the parameters of {!program}. *)
