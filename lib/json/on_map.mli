(** The contents of maps, as JSON: places are pairs of latitude and longitude. *)

open Dolphin_geo

val pair : Position.t -> Yojson.Safe.t
(** Its latitude and its longitude. *)

val path : Position.t list -> Yojson.Safe.t
(** The list of their {!pair}s. *)

val area : Area.t -> Field.members
(** [centre] and [radius], in metres; or [rings], its rims and those of its holes. *)

val fence : Dolphin_plans.Fences.fence -> Yojson.Safe.t
(** The [fence] as it is declared, its [rule], ["inside"], ["outside"], ["depth"], ["height"] or ["distance"], its
    [margin] if there is one; and the {!area}, or the [metres]. *)

val to_fence : Yojson.Safe.t -> (Dolphin_plans.Fences.fence, string) result
(** The output of {!val-fence}, without its place in a text. *)
