(** A fault of a program, told to the person who wrote it. *)

type severity = Error | Warning

type t = {
  at : Location.t;
  message : string;      (** What is wrong. *)
  hint : string option;  (** What would be right. *)
  severity : severity;
}

val error : ?hint:string -> Location.t -> string -> t
(** [error ~hint at message] is an error at [at]. *)

val warning : ?hint:string -> Location.t -> string -> t
(** [warning ~hint at message] is a warning at [at]. *)

val compare : t -> t -> int
(** [compare a b] orders by place in the text, then by message. *)

val pp : source:string -> Format.formatter -> t -> unit
(** [pp ~source ppf d] prints [d] with the line of [source] it points at, and a caret below the place:
    {v
FILE:LINE:COLUMN: error: message
  12 | the source line
     |      ^^^^
     hint: what would be right
    v}
    Columns count characters. A very long line is cut around the caret. A diagnostic without a place is its
    message and hint. *)

val suggest : string -> string list -> string option
(** [suggest x xs] is the member of [xs] that [x] is most likely a misspelling of, if one is near enough:
    letter case, swapped neighbours and a few wrong letters are forgiven. *)
