(** The places where IMC vehicles are searched, on command lines. *)

open Cmdliner
open Dolphin_platform_imc

val s_network : string
(** The section of manual pages that has these options. *)

val definition : string option Term.t
(** [--imc-xml FILE]: the user's own definition of IMC. *)

val options : Udp_platform.options Term.t
(** [--imc-loopback], [--imc-interface], [--imc-port], [--imc-discovery-ports], [--imc-id], [--imc-payload],
    [--imc-type]. *)

val chosen : Udp_platform.options option Term.t
(** [--imc], with these options; [None] without it. Any of the options implies it, and so does [--imc-xml]. *)

val with_names : Dolphin_imc.Definition.t option -> Udp_platform.options -> Udp_platform.options
(** [with_names d options] is [options] with names from [d]. *)
