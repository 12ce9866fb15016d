(** Which rules of the semantics the cases of a corpus take. *)

type t

val empty : t
(** No cases. *)

val add : name:string -> covers:string list -> taken:string list -> t -> t
(** [add ~name ~covers ~taken m] is [m] with case [name], which is about the rules [covers] and takes the rules
    [taken]. *)

val untaken : t -> string list
(** The rules that no case is about, as far as it takes them. *)

val pp : Format.formatter -> t -> unit
(** A line for each rule: its name, how many cases take it, and those that are about it. *)
