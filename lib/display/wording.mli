(** Small texts that the log and the board share. *)

val clock : float -> string
(** [clock seconds] is the time of a stop-watch, in whole seconds: ["0:07"], ["9:00"], ["1:02:03"]. *)

val duration : float -> string
(** [duration seconds] is a span of time as one says it: ["10 s"], ["2 min"], ["1.5 h"],
    ["1 h 1 min 1 s"]. *)

val vehicles : string list -> string
(** [vehicles vs] names [vs], the first ones only if there are many: ["a, b, c and 997 more"]. *)

val harmless : string -> string
(** [harmless text] is [text] without control characters, which could command the terminal; lines stay lines. *)

val width : string -> int
(** [width text] is the number of characters of [text], which is UTF-8. *)

val pad : int -> string -> string
(** [pad n text] is [text], with blanks up to [n] characters. *)
