(** Runs in the Informal Trace Format (ITF), which the tools of TLA+ and Quint read: Apalache's architecture decision
    record 015 has the format.

    Each state has five variables: [control], [A] (from vehicles to the plans that they run), [B] (the vehicles in pick
    order), [N] (from each key to its values, the oldest first where order matters) and [store] (from global variables
    to values). [control] has the program's present step, and the rest of the task that runs. The label and the rules of
    the transition that led to a state are in its ["#meta"].

    Integers are ["#bigint"]s. Values without a form in the format, like numbers with a fraction and tasks, are
    ["#unserializable"] text. A run without end has ["loop"]: the state that follows the last one again; ["back"] in
    the trace's ["#meta"] is the label and the rules of the transition that leads there. *)

open Dolphin_semantics

val trace :
  Core.program -> description:string -> Configuration.t -> Transition.t list -> cycle:Transition.t list -> Yojson.Safe.t
(** [trace p ~description c steps ~cycle] is the run of [p] that starts in [c], takes [steps], and then [cycle] again
    and
    again if there is one. *)
