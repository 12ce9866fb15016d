(** What [spec/DolphinMachine.tla] has a meaning for, where that is known by name. *)

val is_mathematics : string -> bool
(** Whether this function of [Math] is exact on fractions. *)

val is_refused_property : string -> bool
(** Properties whose values are no fractions: coordinates, radians. *)

val is_for_readings : string -> bool
(** Of those that are refused, properties and methods that it knows of positions that may be anything. *)

val is_refused_method : string -> bool
(** Methods of the language that the specification leaves out. Of a name that the language does not know, nothing is
    said: a map may hold a closure of that name. *)
