(** The contents of maps, as JSON: places are pairs of latitude and longitude. *)

open Dolphin_geo

val place : Position.t Codec.t
(** [[latitude, longitude]], of height 0. *)

val pair : Position.t -> Yojson.Safe.t
(** Its latitude and its longitude. *)

val path : Position.t list -> Yojson.Safe.t
(** The list of their {!pair}s. *)

val area : Area.t -> Field.members
(** [centre] and [radius], in metres; or [rings], its rims and those of its holes. *)

val fence : Dolphin_plans.Fences.fence Codec.t
(** A fence as it is declared, its rule, [margin] if there is one, and the {!area}, or the [metres]; without its place
    in a text. *)
