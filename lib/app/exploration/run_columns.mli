(** A run of a program, as the commands that look for one show it. *)

open Dolphin_semantics

val print : Core.program -> steps:Transition.t list -> cycle:Transition.t list -> unit
(** In columns (see {!Dolphin_display.Columns}); the cycle, if any, is what comes after it for ever. *)

val print_waiting : Core.program -> Transition.t list -> unit
(** What the program waits for after this run, if it waits for conditions. *)
