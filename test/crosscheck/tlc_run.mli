(** A run of TLC, whose outcome is all that is asked for. *)

open Dolphin_tlc

val outcome :
  ?line:(string -> unit) -> Installation.t -> main:string -> configuration:string -> (string * string) list -> Outcome.t
(** [outcome ~line i ~main ~configuration files] is TLC's result for the module [main] under [configuration], among
    [files], names and texts; [line] gets the output of the model, line by line. *)

val judge : Outcome.t -> (unit, string) result
(** [judge o] is whether all holds; or TLC's violated property, with the last state. *)
