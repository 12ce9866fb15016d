(** JSON that may be hostile. *)

val read : string -> Yojson.Safe.t
(** [read text] is its value. A byte order mark is skipped, bytes that are not UTF-8 become U+FFFD.
    Raises {!Drawn.Wrong} with line and column; also where lists and objects are nested more
    than {!most_deep} deep. *)

val most_deep : int
(** 100. *)

(** {1 Asking}

    [place] is the place of the value. *)

val member : string -> Yojson.Safe.t -> Yojson.Safe.t
(** [`Null] if it is missing. *)

val elements : string -> Yojson.Safe.t -> Yojson.Safe.t list
(** Those of a list; else wrong at [place]. *)

val number : string -> Yojson.Safe.t -> float
(** A finite number; else wrong at [place]. *)

val text : Yojson.Safe.t -> string option
(** A text, or a whole number as text. *)

(** How a format writes positions. *)
type order = Longitude_first | Latitude_first

val position : order -> string -> Yojson.Safe.t -> Dolphin_geo.Position.t
(** [position order place json] is the position that [json] is, a list of two numbers and perhaps a height. *)
