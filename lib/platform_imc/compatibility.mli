(** The messages that a console and vehicles exchange here, held against another definition of IMC.

    The layouts have been stable since IMC 5.4.2 (2014); a vehicle of an older version, or of a variant, does not
    understand our messages. *)

open Dolphin_imc

val differences : Definition.t -> string list
(** [differences d] is why vehicles that speak by [d] and Dolphin would misunderstand each other, in words: a line for
    each message that Dolphin reads or writes and that [d] lacks or lays out otherwise. Maneuvers may be missing: a
    vehicle refuses a plan with a maneuver that it has not got. *)

val types : Definition.t -> (int * string) list
(** [types d] is the names of [d] for the types of systems (SystemType). *)

val modes : Definition.t -> (int * string) list
(** [modes d] is the names of [d] for the modes of vehicles (VehicleState, [op_mode]). *)
