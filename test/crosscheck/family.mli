(** One model of several programs, so that TLC starts once for all: the graph has an initial state for each, and their
    states have nothing in common, by a variable with the program's number.

    The specification is for one program, which is its constants. Here its [CONSTANTS] are definitions instead, that
    look up the constant of the program at hand; beside that, its text is changed only so that the variable is one of
    [vars], and each transition leaves it as it is; and its assumptions on constants are an invariant. *)

type constant = { name : string; parameters : string list; definition : string }

val configuration : string
(** The name of the file with TLC's configuration. *)

val by_rule : string
(** Of one in which there is an action for each rule. *)

val refined : string
(** The module that is for {!refinement}. *)

val refinement : string
(** Of one that checks [DolphinRefinement.tla], and the types of states. *)

val timed : string
(** The module that is for {!dates}. *)

val dates : string
(** Of one that prints dates ({!Dolphin_tlc.Printed_dates}), for programs that are given with their times. *)

val files : specification:(string * string) list -> constant list list -> ((string * string) list, string) result
(** [files ~specification programs] is the model's files, names and texts: each program is given by its constants,
    and has a number, from 1, in the printed output of the model ({!Dolphin_tlc.Printed_graph}). It is an error if
    the text of the specification is not as expected. *)
