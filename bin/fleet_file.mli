(** Fleets: which one a program is run with, and what is in it. *)

type t = {
  path : string option;  (** [None]: the built-in fleet *)
  source : string;  (** its text; [""] for the built-in fleet *)
  scenario : Dolphin_scenario.Scenario.t;
}

type trouble = Unreadable of string | Wrong of { source : string; found : Dolphin_syntax.Diagnostic.t list }

val choose : program:string -> string option -> string option
(** [choose ~program named] is the file of the fleet to use: [named] if there is one, else the file beside [program], if
    there is one. *)

val load : string option -> (t, trouble) result
(** [load None] is the built-in fleet. *)

val tell : trouble -> unit
(** On standard error. *)

val nobody : Dolphin_scenario.Scenario.t
(** No vehicles, no plans, no answers. *)
