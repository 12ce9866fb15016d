(** Runs whose looks at sensors agree: between two events, or two states that wait, a sensor keeps its value, and a date
    that has passed stays passed. A search of configurations together with {!Looks.moment}s finds them; docs/explorer.md
    has the argument. *)

open Dolphin_semantics
open Dolphin_environment

type start = Configuration.t * Environment.t
(** Where runs begin. *)

val agrees : Core.program -> World.t -> Configuration.t -> Transition.t list -> bool
(** [agrees p w c run] is whether some world, as open as [w], has [run] from [c]. *)

(** The result of a search. *)
type found = {
  runs : (Property.t * Transition.t list) list;  (** of each property the first run that violates it: a shortest one *)
  whole : bool;  (** whether no bound was met: properties without a run hold *)
}

val search :
  tick:(unit -> unit) -> limit:int -> conditions:Condition.t list -> Environment.options -> Core.program -> World.t ->
  start -> Property.t list -> found
(** [search ~tick ~limit ~conditions o p w start sought] is the runs from [start] that violate the properties [sought]:
    those of ends, {!Property.No_deadlock}, and invariants, which are among [conditions]. It meets at most [limit] pairs
    of a configuration and a moment, and stops once each of [sought] has a run. [tick] is called for each pair, and may
    raise. *)
