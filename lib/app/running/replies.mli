(** The fleet's replies to calls of a supplier, without a supplier process. *)

open Dolphin_runtime
module Scenario := Dolphin_scenario.Scenario

val call : past:History.t -> Scenario.t -> Driver.call
(** [call ~past scenario] replies to each call what [scenario] has for it the first time, the second and so on, those
    of [past] included; of several replies, the first. The error lists the possible ones. *)

val are_of : Scenario.t -> History.t -> bool
(** [are_of scenario past] is whether the replies of [past] are those of [scenario], which has one for each call that is
    open, too. *)
