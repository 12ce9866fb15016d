(** The known messages: the built-in ones, and the ones in a user's [IMC.xml]. *)

include module type of struct
  include Dolphin_imc_definition.Definition
end

val builtin : t Lazy.t
(** The messages of {!Message}. *)

val of_imc_xml : string -> (t, Dolphin_imc_definition.Imc_xml.error) result
(** [of_imc_xml path] is the definition in the file [path]: any version of [IMC.xml]. *)
