(** Looks at sensors, and whether they can be of one moment. Between two events a sensor keeps its value, and a date
    that has passed stays passed: docs/explorer.md has the rules. *)

open Dolphin_semantics

type t = World.assumption list list
(** The assumptions of a transition: any of these lists would do. *)

val none : t
(** Nothing. *)

val of_transition : Transition.t -> t
(** [of_transition t] is the assumptions of [t]. *)

val is_event : Transition.t -> bool
(** Whether it answers an event, which time may go before. *)

(** {1:concerns Concerns} *)

type concerns = World.assumption -> bool
(** The assumptions that count; others are left out. *)

val at_one_moment : Core.program -> concerns
(** All that sensors and the date show. A comparison with a variable is left out, for the variable may be assigned. *)

val of_date : Core.program -> concerns
(** Comparisons of the date with numbers: on a run without end each of them comes to one outcome, and keeps it. *)

(** {1:known Knowledge} *)

type known
(** Assumptions that hold at that moment, and others that do not. *)

val nothing : known
(** No assumption. *)

val admits : concerns -> known -> t -> bool
(** [admits c k looks] is whether some list of [looks] agrees with [k], as far as [c] concerns it. *)

(** Whether many looks agree. *)
type outcome =
  | Agree  (** all can be of one moment *)
  | Ask of known * known  (** it takes to know more: each moment is of the one kind or of the other *)

val compare_all : concerns -> known -> t list -> outcome
(** [compare_all c k all] is whether a moment at which [k] holds may have all of [all]. *)

val agree : concerns -> t list -> bool
(** [agree c all] is whether [all] can be of one moment. *)
