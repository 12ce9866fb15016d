(** Texts of the form [label1=value1;label2=value2], such as the settings of a maneuver.

    Source: IMC, unit TupleList. [=] and [;] cannot be part of a label or value. *)

type t = (string * string) list

val of_string : string -> t
(** [of_string s] is the pairs of [s] without blanks around labels and values. A part without [=] has
    the empty value; empty parts are left out. *)

val to_string : t -> string
(** [of_string (to_string t) = t] if no label or value has [=], [;], or blanks around it, or is an empty
    label. *)

val find : string -> t -> string option
(** [find label t] is the first value of [label]. *)
