(** Specifications that are wrong in one place: the comparison with the explorer must notice each. *)

type t = {
  name : string;  (** what it does wrong, in a few words *)
  file : string;  (** of [spec/] *)
  pattern : string;  (** stands in the file exactly once *)
  replacement : string;
}

val about : string -> t list
(** [about part] is those with [part] in their names. *)

val apply : t -> (string * string) list -> ((string * string) list, string) result
(** [apply m files] is [files], names and texts, with [m]'s mistake in them; or why it does not apply. *)
