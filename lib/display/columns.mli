(** A run of the semantics as a table: a row for each transition, a column for the program and one for each vehicle, so
    that one sees who did what in which order. For counter-examples.

    {v
     program              noptilus-1       x8-02            where
  1  picks noptilus-1                                       mission.dol:3
  2                       starts survey1                    mission.dol:9
    v} *)

open Dolphin_semantics

(** A line of the table. *)
type row = {
  actor : string;  (** a vehicle, or ["program"] *)
  text : string;  (** its deed *)
  at : Dolphin_syntax.Location.t option;  (** its place in the program *)
  words : string;  (** the log's words for it, where [text] is a short label; or [""] *)
  assumed : World.assumption list;
  changed : (string * string) list;
  (** the variables that it assigned, or steps without a line before it, with their values *)
}

val rows : ?before:Configuration.t -> Core.program -> source:string -> Transition.t list -> row list
(** [rows ~before program ~source run] is the rows of [run], which begins in [before], by default the initial
    configuration. *)

val row : ?shown:Configuration.t -> Core.program -> source:string -> Configuration.t option -> Transition.t -> row
(** [row ~shown program ~source before t] is the line of [t], which was taken from [before], the initial configuration
    if that is [None]. Variables are compared with those of [shown], by default [before]. *)

val place : row -> string
(** [place row] is the place in the program: ["mission.dol:9"], or [""]. *)

val lines :
  ?first:int -> ?heads:string list -> ?columns:int -> ?before:Configuration.t -> ?remarks:(int * string) list ->
  source:string -> Core.program -> Transition.t list -> string list
(** [lines ~source program run] is the table of [run]; [source] is the text of [program]. Silent transitions have no
    row. Rows are numbered from [first], by default 1, or have [heads] instead, a text for each transition. The
    assumptions of a transition in an open world stand below it, then its remark of [remarks], by its place in [run],
    from 0. A column has the variables that changed. If [columns] is given, the table is made to fit into it: with the
    beginning of long texts, and the log's words for guards and timers in a last column, if there is room for it; if the
    columns of all do not fit, each row has the name of its vehicle instead. *)
