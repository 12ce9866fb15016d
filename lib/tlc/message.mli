(** The output of TLC with [-tool], line by line: messages with a code, and whatever else is printed, by SANY or by the
    model. TLC's class [MP] writes the format.

    {v
\@!\@!\@STARTMSG 2190:0 \@!\@!\@
Finished computing initial states: 1 distinct state generated at 2026-01-01 12:00:00.
\@!\@!\@ENDMSG 2190 \@!\@!\@
    v} *)

(** The severity of a message, as TLC numbers them. *)
type severity = Information | Error | Bug_of_tlc | Warning | State

type t =
  | Message of { code : int; severity : severity; text : string }  (** [text] may have several lines *)
  | Line of string  (** a line outside of messages *)

type reader
(** The part read of a message that has not ended yet, if any. *)

val start : reader
(** No line was read. *)

val line : reader -> string -> reader * t list
(** [line r s] takes in the next line, [s], and gives the messages that it completes. A message that begins before the
    last one has ended ends that one. A carriage return at the end of a line does not count. *)

val finish : reader -> t list
(** [finish r] is the rest when the output ends: the message that was cut off, if any. *)

val of_string : string -> t list
(** All of an output. *)
