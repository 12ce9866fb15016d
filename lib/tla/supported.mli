(** The functions, properties and methods that [spec/DolphinMachine.tla] has, by name. *)

val is_mathematics : string -> bool
(** Whether this function of [Math] is exact on fractions. *)

val is_refused_property : string -> bool
(** Properties whose values are not fractions: coordinates, radians. *)

val is_for_readings : string -> bool
(** Whether the specification has this property or method, which is refused otherwise, of positions that may be
    anything. *)

val is_refused_method : string -> bool
(** Whether this is a method of the language that the specification leaves out. A name that the language does not know
    is not refused: a map may hold a closure of that name. *)
