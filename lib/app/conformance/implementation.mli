(** Another implementation of the semantics, in a process that speaks the step protocol on its standard input and
    output. *)

type t

val make : timeout:float -> string -> t
(** [make ~timeout command] is the implementation that the shell command [command] starts, which is done when it is
    first asked, and again after it died or was given up. It has [timeout] seconds for each reply. *)

val ask : t -> Dolphin_conformance.Dialogue.ask
(** Its reply to a request; a reply that is late, not an object, or another request's is an error, and ends the
    process. @raise Invalid_argument if the request is not an object. *)

val close : t -> unit
(** Ends the process. *)
