(** The places that programs know by name, as in [Location.APDL]. *)

val apdl : Position.t
(** The harbour of Leixões (Administração dos Portos do Douro e Leixões), height 0. *)

val feup : Position.t
(** The Faculty of Engineering of the University of Porto, height 0. *)

val all : (string * Position.t) list
(** All of them by name (["APDL"], ["FEUP"]), in alphabetical order. *)

val find : string -> Position.t option
(** [find name] is [List.assoc_opt name all]. *)
