(** Footprints: reads and writes of code and steps on the part that the components of a task share. An upper bound,
    found without running them. Two steps whose footprints do not conflict commute. *)

open Dolphin_semantics

(** {1:footprints Footprints} *)

module Globals : Set.S with type elt = int
(** Global variables, by their indices. *)

(** Pairs of N by key and value; without value: all with that key. *)
module Pairs : sig
  include Set.S with type elt = string * Core.value option

  val meet : t -> t -> bool
  (** [meet a b] is whether some pair may be in both. *)
end

(** Some of B. *)
type vehicles

val these : Core.vehicle list -> vehicles
(** [these vs] is just the vehicles [vs]. *)

val all_vehicles : vehicles
(** All of B, whatever it is. *)

type t = {
  posts : Pairs.t;
  queues : Pairs.t;  (** those of [posts] whose order matters *)
  takes : Pairs.t;  (** pairs that it may take; they are among [needs] or [tests] too *)
  needs : Pairs.t;  (** pairs that a guard needs: it holds, with the same effect, if there are more of any *)
  tests : Pairs.t;  (** pairs whose being there or not may matter in any way *)
  reads : Globals.t;
  writes : Globals.t;
  anything : bool;  (** nothing is known: code that cannot be seen may be called *)
  claims : vehicles;  (** that it may come to hold, or looks whether they are held, or run a task *)
  frees : vehicles;  (** that may be held no longer after it; if code asks who runs, whose task may start or end too *)
  looks : bool;  (** its code may depend on held vehicles or running tasks *)
  remembered : bool;  (** the outside may remember it, for a later [pick] *)
  breaks : bool;  (** it may be faulty, or fail *)
  halts : bool;  (** it may end the run, by [halt] or an assertion that fails *)
  ignores : bool;  (** a handler: it may ignore the error *)
}

val empty : t
(** Of code that touches nothing. *)

val anything : t
(** Of code that cannot be seen. *)

val union : t -> t -> t
(** [union a b] is the footprint of code that does what [a] and [b] do. *)

val touches_nothing : t -> bool
(** [touches_nothing f] is whether [f] touches nothing, so that it conflicts with nothing. *)

val leaves_no_trace : t -> bool
(** [leaves_no_trace f] is whether [f] changes nothing: if the step is cut off, it makes no difference whether it was
    taken before. *)

val reads_nothing : t -> bool
(** [reads_nothing f] is whether the step is independent of the shared part. *)

val conflict : possible:bool -> t -> t -> bool
(** [conflict ~possible f f'] is [false] only if a step with footprint [f], [possible] now or not, is as possible after
    steps with footprint [f'], with the same effect, and these steps are possible, with the same effect, after it. *)

val is_small : Core.value -> bool
(** [is_small x] is whether [x] is looked through: values may hold their parts many times over. *)

val of_posts : Core.program -> (string * Core.value) list -> t
(** [of_posts p pairs] is the footprint of posting [pairs]. *)

(** {1:code Code} *)

type code
(** The footprints of a program's code, memoised. Mutable. *)

val code : Core.program -> code
(** [code p] is for the code of [p], of which none has been looked at. *)

val of_code : code -> Core.closure -> t
(** Of any code. *)

val of_guard : code -> Core.closure -> t
(** Of code that does something only where its value is true. *)

val of_maker : code -> Core.closure -> t
(** Of code that makes a task, and of that task. *)

val claims : t -> bool
(** [claims f] is whether it depends on which vehicles are held. *)

val asks_held : Core.program -> bool
(** [asks_held p] is whether the effect of some code of [p] may depend on held vehicles: [idle(V)], [dismiss V], and
    [running(v)]. *)

val of_ensured : Core.program -> Core.ensured list -> t
(** [of_ensured p ds] is the footprint of the end of a task that does [ds]. *)

val all_ensured : Core.program -> t option
(** [all_ensured p] is a footprint that has that of all that [ensure] in [p] may do; [None] if [p] has none. *)

val dismisses : Core.program -> bool
(** [dismisses p] is whether some handler of [p] may dismiss vehicles. *)
