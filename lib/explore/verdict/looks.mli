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
(** All that sensors and the date show. A comparison with a variable is left out, for the variable may be assigned; so
    is one of progress, which is 0 again once a task begins. *)

val of_date : Core.program -> concerns
(** Comparisons of the date with numbers: on a run without end each of them comes to one outcome, and keeps it. *)

(** {1:readings Readings} *)

val pp_readings : Format.formatter -> World.assumption list -> unit
(** The disjunction of these, as conditions: ["battery(a) > 0.8"], ["battery(a) is 0.9 or battery(a) is 1"]. *)

val is_look : concerns -> t -> bool
(** [is_look c looks] is whether a reading that [c] concerns is needed. *)

val are_at : concerns -> World.assumption list -> t -> bool
(** [are_at c readings looks] is whether [looks], as far as [c] concerns them, are at a sensor of [readings]. *)

val may_show : concerns -> World.assumption list -> t -> bool
(** [may_show c readings looks] is whether a moment at which one of [readings] is shown can have [looks]. *)

val readings : concerns -> t -> World.assumption list
(** [readings c looks] is all assumptions in [looks] that [c] concerns. *)

val may_repeat : Core.program -> assumed:World.assumption list list -> Transition.t list -> bool
(** [may_repeat p ~assumed cycle] is whether a run may repeat these transitions of the script without end: their looks
    agree, if there is no event among them, those at the date in any case, and each of [assumed] may be shown at a look,
    or all looks may be at something else. *)

(** {1:known Knowledge} *)

type known
(** Assumptions that hold at that moment, and others that do not. *)

val nothing : known
(** No assumption. *)

val admits : concerns -> known -> t -> bool
(** [admits c k looks] is whether some list of [looks] agrees with [k], as far as [c] concerns it. *)

(** {2:moments Moments} *)

type moment = World.assumption list
(** The assumptions that were looked at since time has passed, in order and each once. *)

val compare_moments : moment -> moment -> int
(** A total order. *)

val beginning : moment
(** None: time has just passed. *)

val after : concerns -> moment -> t -> moment list
(** [after c m looks] is the moments that begin with [m] and have [looks], as far as [c] concerns them: [[]] if these
    contradict [m]. One that knows more than another is left out, as all that is possible at it is so at the other. *)

val contested : concerns -> t list -> concerns
(** [contested c all] is those assumptions of [all] that [c] concerns and that contradict another of these. *)

(** {2:many Many looks} *)

(** Whether many looks agree. *)
type outcome =
  | Agree  (** all can be of one moment *)
  | Ask of known * known  (** it takes to know more: each moment is of the one kind or of the other *)

val compare_all : concerns -> known -> t list -> outcome
(** [compare_all c k all] is whether a moment at which [k] holds may have all of [all]. *)

val agree : concerns -> t list -> bool
(** [agree c all] is whether [all] can be of one moment. *)
