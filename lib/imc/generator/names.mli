(** OCaml names for the names of IMC. *)

val module_ : string -> string
(** [module_ "PlanDBState"] is ["Plan_db_state"]: a module, or a constructor. *)

val label : string -> string
(** [label "angAperture"] is ["ang_aperture"], [label "type"] is ["type_"]: a record label. *)

val constructor : string -> string
(** [constructor "METERS_PS"] is ["Meters_ps"]. *)

val value : string -> string
(** [value "WAIT_AT_SURFACE"] is ["wait_at_surface"], [value "3DTRACK"] is ["bit_3dtrack"]. *)
