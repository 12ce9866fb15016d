(** A run of TLC, whose outcome is all that is asked for. *)

open Dolphin_tlc

val outcome :
  ?line:(string -> unit) -> Installation.t -> main:string -> configuration:string -> (string * string) list -> Outcome.t
(** [outcome ~line i ~main ~configuration files] is what TLC finds of the module [main] under [configuration], among
    [files], names and texts; [line] is given what the model prints, line by line. *)

val judge : Outcome.t -> (unit, string) result
(** [judge o] is whether all holds; or what TLC says does not, with the last state. *)
