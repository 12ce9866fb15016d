(** Drawings for Graphviz' [dot]. *)

val write : ?name:string -> (string -> unit) -> Graph.t -> unit
(** [write out g] calls [out] with the parts of the drawing of [g], in order. States show their texts or, if they have
    none, their numbers; an arrow leads to the initial state; a state that no transition leaves has a double edge.
    [name] is that of the drawing, ["lts"] unless given. *)

val to_string : ?name:string -> Graph.t -> string
(** The text that {!write} writes. *)
