(** The invocation of TLC on a model, and its questions. *)

val main : string
(** ["MC"], the name of the module. *)

(** A property of a configuration of TLC, by its name in the model. *)
type property = { name : string; of_runs : bool  (** a temporal property; otherwise an invariant *) }

val check : string
(** The name of the file with the configuration that checks the properties. *)

val check_states : string
(** The name of the same without temporal properties, which TLC's distributed mode cannot check. *)

val graph : string
(** The name of the one that checks nothing, and prints the graph in the lines that [Dolphin_tlc.Printed_graph] reads.
    TLC must have one worker, for a state's lines to stay together. *)

val properties : strict:bool -> property list
(** The properties of {!check}; with [strict] also that no run halts, and that no tuples are left. *)

val files : strict:bool -> Model.file list -> Model.file list
(** [files ~strict model] is [model] with the configurations {!check} and {!check_states}. *)
