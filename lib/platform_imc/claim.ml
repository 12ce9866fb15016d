open Dolphin_semantics
open Dolphin_imc

type t = { program : string; run : string; resuming : bool; vehicles : Core.vehicle list }

let name = "dolphin.holds"
let patience = 5.

let to_message claim =
  let parameter name value : Message.Entity_parameter.t = { name; value } in
  let only_if condition p = if condition then [ p ] else [] in
  let params =
    (parameter "program" claim.program :: only_if (claim.run <> "") (parameter "run" claim.run))
    @ only_if claim.resuming (parameter "resuming" "1")
    @ List.map (parameter "vehicle") claim.vehicles
  in
  Message.Entity_parameters { name; params }

let of_message (m : Message.Entity_parameters.t) =
  let values name =
    List.filter_map (fun (p : Message.Entity_parameter.t) -> if p.name = name then Some p.value else None) m.params
  in
  if m.name <> name then None
  else
    Some
      { program = String.concat "" (values "program"); run = String.concat "" (values "run");
        resuming = values "resuming" <> []; vehicles = values "vehicle" }

let obstacle ~console claim =
  if claim.program = "" then "is held by " ^ console
  else Printf.sprintf "is held by the program %s of %s" claim.program console
