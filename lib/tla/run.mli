(** Models that tell labels: what TLC shows of a run can then be told in the words of the language.

    The module [Run] extends [MC] by a variable, [label], of the step that was taken last. It is no part of the state: the
    configurations leave it out by a [VIEW], so that states, transitions and verdicts are those of [MC]. *)

val main : string
(** ["Run"], the name of the module. *)

type property = { name : string; of_runs : bool  (** a temporal property; otherwise an invariant *) }

val check : string
(** The name of the file with the configuration that checks the properties. *)

val check_states : string
(** Of the same, without temporal properties, for where they cannot be checked. *)

val graph : string
(** Of one that checks nothing, and prints the graph in the lines that [Dolphin_tlc.Printed_graph] reads. TLC must be given
    one worker, for a state's lines to stay together. *)

val printing : string
(** The definition of [PrintGraphOf(number)] in TLA+, which prints the state that TLC is at, for a module that extends
    [Dolphin]. *)

val properties : strict:bool -> property list
(** What {!check} checks; [strict], also that nothing halts, and that no tuples are left. *)

val files : strict:bool -> Model.file list -> Model.file list
(** [files ~strict model] is [model] and the files of this module. *)
