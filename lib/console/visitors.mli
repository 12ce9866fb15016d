(** Identities of clients. Each client has a key, which only it and the server know, and a name, which all see. *)

type t

val make : unit -> t
(** Names of another [make] differ. *)

val is_key : string -> bool
(** Whether a client may have this key: 1 to 64 letters, digits, points, dashes and underscores. *)

val owner : string -> string
(** [owner name] is the operator of the client with this name, or the role of one without. *)

val name : t -> ?operator:string -> Operators.role -> string -> string
(** [name v ~operator role key] is the name of the client with [key]; it begins with the name of the operator, if it
    has one, or else with the role. The key cannot be computed from the name, and a client that
    watches never has the name of one that steers. *)
