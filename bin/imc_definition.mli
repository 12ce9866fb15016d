(** The user's own [IMC.xml], on command lines. *)

open Cmdliner
open Dolphin_imc

val file : string option Term.t
(** [--imc-xml FILE]. *)

val load : string option -> (Definition.t option, Exit_status.t) result
(** [load file] is the definition in [file]. What is wrong with it is told, with its place; so is each message that
    Dolphin speaks otherwise than it says. *)
