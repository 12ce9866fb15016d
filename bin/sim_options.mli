(** The options of [dolphin sim] that describe the vehicles. *)

open Cmdliner

val settings : (Dolphin_scenario.Scenario.t -> Dolphin_sim_imc.Network.settings) Term.t
(** The fleet of a command line. *)

val natural : float Arg.conv
(** A number, 0 or greater. *)

(** {1:sections Sections of the manual page} *)

val faults_section : string
(** The section of manual pages with the options on faults. *)

val network_section : string
(** The same for the effects of the network on datagrams. *)
