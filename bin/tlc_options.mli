(** Options of [dolphin tla] that are about running TLC. *)

open Cmdliner

val jar : string option Term.t
(** [--tlc JAR] *)

val workers : Dolphin_tlc.Invocation.workers option Term.t
(** [--workers N] or [auto] *)

val distributed : (string * int) option Term.t
(** [--distributed HOST:PORT] *)

val coverage : bool Term.t
(** [--coverage] *)

val man : Manpage.block list
(** The manual's text about running TLC. *)
