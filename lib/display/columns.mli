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
}

val rows : Core.program -> source:string -> Transition.t list -> row list
(** [rows program ~source run] is the rows of [run], the first one first. *)

val row : Core.program -> source:string -> Configuration.t option -> Transition.t -> row
(** [row program ~source before t] is the line of [t], which was taken from [before], the initial configuration if that
    is [None]. *)

val place : row -> string
(** [place row] is the place in the program: ["mission.dol:9"], or [""]. *)

val lines :
  ?first:int -> ?heads:string list -> ?columns:int -> source:string -> Core.program -> Transition.t list -> string list
(** [lines ~source program run] is the table of [run]; [source] is the text of [program]. Silent transitions have no
    row. Rows are numbered from [first], by default 1, or have [heads] instead, a text for each transition; of long
    texts the beginning is shown. The assumptions of a transition in an open world stand below it. The table is made
    to fit into [columns], if it is given: with the log's words for guards and timers in a last column, if there is
    room for it; if the columns of all do not fit, each row has the name of its vehicle instead. *)
