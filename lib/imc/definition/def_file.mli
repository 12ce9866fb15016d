(** The project's own format for message definitions. [lib/imc/messages.def] describes it at its head. *)

(** The first fault of a text, with its reason in a sentence without a full stop. *)
type error = {
  line : int;  (** From 1; 0 if the fault is not of one line: a name that nothing defines. *)
  why : string;
}

val parse : string -> (Definition.t, error) result
(** [parse text] is the definition that [text] spells. *)

val pp_error : Format.formatter -> error -> unit
(** ["line 12: expected a value and its name"]. *)
