(** The situations of the kit: the required behaviour of every adapter, each a script of orders. *)

type plans = {
  short : string;  (** a plan, by name, that a vehicle runs to its end within {!field-patience} *)
  long : string;  (** one that lasts longer than all situations together *)
  vehicle : string option;  (** only this vehicle; otherwise the first one that is ready *)
  patience : float;  (** seconds that an answer may take *)
}

type t = {
  name : string;
  what : string;  (** the required behaviour *)
  script : plans -> started:(Talk.t -> unit) -> string -> string option Lwt.t;
  (** [script plans ~started command] fails with {!Talk.Wrong}; or it gives a remark. [started] gets each adapter that
      it starts, for their transcripts and their end. *)
}

val all : t list
(** All situations, in the order in which the kit tries them. *)
