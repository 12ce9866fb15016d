(** Who commands: one page or program at a time, the others watch and may ask. Pure. *)

type t

val free : t
(** Nobody has the helm. *)

val equal : t -> t -> bool

val holder : t -> string option
val asking : t -> string list
(** Those who ask for it, the first one first. *)

val command : t -> string -> (t, string) result
(** [command h client] is before a command of [client], who gets the helm if it is free; or why [client] may not. *)

val ask : t -> string -> t
(** [ask h client] gives the helm to [client] if it is free, or notes that [client] asks for it: at most ten do. *)

val give_up : t -> string -> t
(** [give_up h client]: whoever asked first has the helm if [client] had it; [client] does not ask any more. *)

val is_name : string -> bool
(** Whether a client may be called so: 1 to 64 letters, digits, points, dashes and underscores. *)
