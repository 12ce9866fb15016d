include Dolphin_imc_definition.Definition

let builtin =
  lazy
    (match Dolphin_imc_definition.Def_file.parse Builtin.page with
     | Ok definition -> definition
     | Error error ->
       (* The build has read the same page already, or [Message] would not exist. *)
       Fmt.failwith "messages.def: %a" Dolphin_imc_definition.Def_file.pp_error error)

let of_imc_xml = Dolphin_imc_definition.Imc_xml.read
