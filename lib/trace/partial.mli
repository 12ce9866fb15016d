(** Partial traces, which have only some of the labels, or some events, of a run. A program has a run like that if there
    are hidden steps that lead from each line to the next one. They are searched for. *)

open Dolphin_semantics

type t

val start : observed:string list -> most:int -> World.t -> Core.program -> t
(** [start ~observed ~most world program] is before the first line. Of the labels of the kinds [observed], such as
    ["start"] and ["done"], the trace has each that there was, in order; the others are hidden. With [[]] it has all.
    Answers, replies of the host and interruptions are never hidden. [world] is the vehicles known from the
    beginning. At most [most] configurations are visited between two lines. *)

(** Why no step fits a line. *)
type mismatch = { reason : string;  (** without a full stop *) possible : string list  (** labels that could come *) }

(** The reason why no run is known to have this trace. *)
type trouble = Impossible of mismatch | Too_many  (** more than [most] configurations: it is not known *)

val feed : t -> Entry.t -> (t, trouble) result
(** [feed p line] is [p] after [line], with all configurations that [line] may lead to. *)

val lines : t -> int
(** How many labels and events there were. *)

val is_over : t -> bool
(** The last line was the end of a run. *)

val kind : string -> string
(** [kind label] is its first word: ["start"] of ["start(v, p)"], ["post"] of ["post x:1"]. *)
