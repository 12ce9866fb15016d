(** Fleet files, from the text to the entries. The grammar of programs is theirs too; one table for vehicles and one
    for plans gives the arguments of each setting. *)

open Dolphin_syntax

val read :
  chart:(string -> (Dolphin_semantics.Chart.t, string) result) -> file:string -> string ->
  (Entry.t, Diagnostic.t list) result
(** See {!Scenario.read}. *)

val replies_at : file:string -> string -> (string * Location.t) list
(** See {!Scenario.replies_at}. *)

val vehicle_settings : string list
(** The names of the settings of vehicles, as in {!Scenario}. *)

val plan_settings : string list
(** The names of settings, as in {!Scenario}. *)
