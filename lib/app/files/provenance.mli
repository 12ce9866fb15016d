(** The inputs of a result, for users who combine results. *)

val members : version:string -> Program_file.t -> Fleet_file.t -> Dolphin_json.Field.members
(** The version of Dolphin, digests of the texts of program and fleet, and the parameters that were set. Results of
    whose inputs one differs have other members. *)
