(** Who commands: one page or program at a time, the others watch, may ask for the helm, or take it by force. Pure. *)

type t

val free : t
(** No client has the helm. *)

val equal : t -> t -> bool
(** Whether the holder, those who ask and the former holder are the same. *)

val holder : t -> string option
(** The client that has it. *)

val asking : t -> string list
(** The clients that ask for it, the first one first. *)

val taken_from : t -> string option
(** From whom the holder has taken it by force, if it has. *)

val command : t -> string -> (t, string) result
(** [command h client] is before a command of [client], who gets the helm if it is free; or why [client] may not. *)

val ask : t -> string -> t
(** [ask h client] gives the helm to [client] if it is free, or notes that [client] asks for it: at most ten do. *)

val force : t -> string -> t
(** [force h client] gives the helm to [client], also if another client has it. *)

val give_up : t -> string -> t
(** [give_up h client]: the first client that asked has the helm if [client] had it; [client] does not ask any more. *)
