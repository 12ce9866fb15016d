(** Journals, read line by line. No line takes more memory than {!longest}. *)

type t

val of_channel : in_channel -> t
(** The channel is in binary mode, and read by nobody else. Reading may raise [Sys_error]. *)

val of_string : string -> t
(** Reads the journal that the text is. *)

type item =
  | Line of { number : int;  (** from 1 *) entry : Entry.t }
  | Torn of int  (** the last line, of this number, was not written to its end: the console died *)
  | End_of_file
  | Wrong of { number : int; why : string }  (** a line that is no line of a journal *)

val next : t -> item
(** The first line is a header, and no other one is: else it is [Wrong]. *)

val whole : t -> int
(** [whole r] is how many bytes the lines have that were read so far and have an end. *)

val breaks_off : in_channel -> bool
(** [breaks_off channel]: from where it stands the channel has the journal of a run that took a transition at least and
    has not ended. It is read to its end; what is no journal does not break off. *)

val longest : int
(** 16 MiB. *)
