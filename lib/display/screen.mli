(** The output of a log. On a terminal the board stands under it and is redrawn as things change, at most ten times a
    second; elsewhere lines come as they are, and the board never. *)

type t

val make : live:bool -> on_closed:(Unix.error -> unit) -> Unix.file_descr -> t
(** [make ~live ~on_closed output] writes to [output], with a board if [live]. When [output] cannot be written any
    more (its reader is gone or its disk is full), [on_closed] gets the reason, once, and nothing is written from
    then on. *)

val print : t -> string -> unit
(** [print s text] adds the lines of [text] to the log. *)

val show : t -> (rows:int -> columns:int -> string list) -> unit
(** [show s board] has the lines [board ~rows ~columns] under the log from now on: at most [rows], of [columns]
    characters. Input is not echoed while the board is shown, for it would move the board. A job in the background
    has no board. *)

val changed : t -> unit
(** [changed s] redraws the board, as its lines have changed. *)

val ask : t -> string -> unit
(** [ask s prompt] shows [prompt] at once, the cursor behind it and no board under it, until {!answered}. *)

val is_asking : t -> bool
(** [is_asking s] is whether the last line is a question. *)

val answered : t -> string option -> unit
(** [answered s text] ends the line of the question with [text]; [None] after what was typed there, which ended it. *)

val suspend : t -> stop:(unit -> unit) -> unit
(** [suspend s ~stop] leaves the terminal to others while [stop ()] lasts, and then shows the board again. *)

val restore : t -> unit
(** [restore s] shows what is typed again: before the process ends at once. *)

val close : t -> unit
(** [close s] writes what is left, takes the board away, and leaves the terminal as it was. *)
