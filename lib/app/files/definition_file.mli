(** The user's own definition of IMC, [IMC.xml]. *)

val load : string option -> (Dolphin_imc.Definition.t option, Error.t) result
(** [load path] is the definition in the file [path], if one is named. It is an error if it is not a definition, or
    if Dolphin's messages differ from it: the error then has a line for each of them. *)
