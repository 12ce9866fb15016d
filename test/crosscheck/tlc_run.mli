(** A run of TLC, whose outcome is all that is asked for. *)

open Dolphin_tlc

val outcome : Installation.t -> main:string -> configuration:string -> (string * string) list -> Outcome.t
(** [outcome i ~main ~configuration files] is what TLC finds of the module [main] under [configuration], among [files],
    names and texts. *)
