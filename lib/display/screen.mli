(** Where a log goes. On a terminal the board stands under it and is redrawn as things change, at most ten times a
    second; elsewhere lines come as they are, and the board never. *)

type t

val make : live:bool -> on_closed:(Unix.error -> unit) -> Unix.file_descr -> t
(** [make ~live ~on_closed output] writes to [output], with a board if [live]. When [output] cannot be written any more,
    for nobody reads it or its disk is full, [on_closed] is told why, once, and nothing is written from then on. *)

val print : t -> string -> unit
(** [print s text] adds the lines of [text] to the log. *)

val show : t -> (unit -> string list) -> unit
(** [show s board] has the lines [board ()] under the log from now on. *)

val changed : t -> unit
(** [changed s] has the board redrawn, as its lines are no longer what they were. *)

val ask : t -> string -> unit
(** [ask s prompt] shows [prompt] at once, the cursor behind it and no board under it, until {!answered}. *)

val answered : t -> string option -> unit
(** [answered s text] ends the line of the question with [text]; [None] after what was typed there, which ended it. *)

val close : t -> unit
(** [close s] writes what is left, and takes the board away. *)
