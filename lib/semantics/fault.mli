(** What went wrong while a program ran: in its own code, or on a vehicle. *)

type t = {
  message : string;  (** one sentence without a full stop: what is wrong, and where it helps, what would be right *)
  site : Core.site;  (** the place in the program that failed; {!unknown_site} if there is none *)
}

val unknown_site : Core.site

val make : Core.site -> string -> t

val location : Core.program -> t -> Dolphin_syntax.Location.t option
(** [location p f] is where in [p]'s text [f] happened. *)

