(** Phrases that people read, on terminals and in pictures. *)

val time : float -> string
(** [time seconds] is the time of a stop-watch, in whole seconds: ["0:07"], ["9:00"], ["1:02:03"]. *)

val count : int -> string -> string
(** [count 2 "line"] is ["2 lines"], [count 1 "line"] is ["1 line"]. *)

(** {1 Texts of others}

    Names of vehicles and messages may come from anywhere. *)

val harmless : string -> string
(** [harmless text] is [text] without characters that could command the terminal or reorder the line
    ({!Dolphin_utf8.Utf8.is_unfit}), and in UTF-8; lines stay lines. *)

val one_line : string -> string
(** [one_line text] is [harmless text] with a blank for each end of a line. *)

val width : string -> int
(** [width text] is the number of characters of [text]. *)

val pad : int -> string -> string
(** [pad n text] is [text], with blanks up to [n] characters. *)

val split : int -> string -> string * string
(** [split n text] is the first [n] characters of [text], and the others. *)
