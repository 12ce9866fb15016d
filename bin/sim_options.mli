(** The options of [dolphin sim] that say what the vehicles are like. *)

open Cmdliner

val settings : (Dolphin_scenario.Scenario.t -> Dolphin_sim_imc.Network.settings) Term.t
(** What the command line makes of a fleet. *)

val natural : float Arg.conv
(** A number, 0 or greater. *)

(** {1:sections Sections of the manual page} *)

val faults_section : string
(** The section of manual pages that has the options on what goes wrong. *)

val network_section : string
(** Likewise on what the network does to datagrams. *)
