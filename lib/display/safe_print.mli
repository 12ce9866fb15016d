(** Text for people, on standard output. It may quote names and texts from anywhere, the names of files among them:
    {!Dolphin_trace.Phrase.harmless} makes them fit for terminals. Data, such as JSON, is not printed by this. *)

val line : string -> unit
(** [line text] prints [text] and the end of a line, and flushes. *)

val printf : ('a, unit, string, unit) format4 -> 'a
(** [printf format] prints as [Printf.printf], and flushes. *)

val format : ('a, Format.formatter, unit, unit) format4 -> 'a
(** [format format] prints as [Format.printf], and flushes. Boxes end where the text ends. *)
