(** Specifications that are wrong in one place: the comparison with the explorer must notice each. *)

type t = {
  name : string;  (** its fault, in a few words *)
  file : string;  (** of [spec/] *)
  pattern : string;  (** stands in the file exactly once *)
  replacement : string;
}

val about : string -> t list
(** [about part] is those with [part] in their names. *)

val is_of_checking : t -> bool
(** Whether the mistake is in [DolphinChecking.tla]. Such a mistake leaves graphs as they are, but not TLC's own
    verdicts. *)

val is_of_abstract : t -> bool
(** Whether it is in [Abstract.tla]: its theorems must notice. *)

val is_of_refinement : t -> bool
(** Whether it leaves graphs as they are, but changes the result of {!Refined.programs}. *)

val is_of_time : t -> bool
(** Whether it is in [Timed.tla]: the comparison of {!Dated.programs} must notice it. *)

val apply : t -> (string * string) list -> ((string * string) list, string) result
(** [apply m files] is [files], names and texts, with [m]'s mistake in them; or why it does not apply. *)
