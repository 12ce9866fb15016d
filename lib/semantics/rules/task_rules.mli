(** The rules of tasks, from docs/semantics.md: the steps of a residual. Steps are data: the needs of a step from the
    shared part and the world (an {!type-offer}), and with these, the rules' conclusion (a {!type-change}).
    {!Local_step} makes steps of the shared part from these. *)

open Core
open Residual

(** {1:steps Steps} *)

(** The needs of a step; the parameter is the type of the reply that it goes on with. An error is the reason: the
    code is faulty, or the vehicle's failure. *)
type _ offer =
  | Start : platform_task * vehicle -> unit offer  (** nothing; A(v) becomes the task *)
  | Perform : closure -> (Code.deed list, Fault.t) result offer  (** to run this action: its deeds *)
  | Check : closure -> (Code.deed list, Fault.t) result offer  (** that this guard is true: its deeds *)
  | Guard_false : closure -> (unit, Fault.t) result offer  (** that this guard is not true; the deeds of its code are
                                                               undone *)
  | Guard_either : closure -> (bool * Code.deed list, Fault.t) result offer
  (** whether this guard is true, and its deeds; if not, the deeds of its code are undone *)
  | Guard_values : closure -> (Code.deed list, Fault.t) result offer  (** as [Check]; its result depends on the deeds *)
  | Measure : closure -> (float, Fault.t) result offer  (** the seconds that this code gives *)
  | Make : closure * value list * request -> (task, Fault.t) result offer
  (** the task that this code gives of these values *)
  | Allocate : task * request -> (vehicle list * t, Fault.t) result offer
  (** free vehicles for this task: these, and the rest of the task *)
  | End_of : platform_task * vehicle -> (unit, string) result offer  (** that the vehicle reports the end *)
  | Expiry_of : timer -> unit offer  (** that the timer expires *)
  | Answer_to : timer * string -> (bool, string) result offer
  (** that the question of this prompt is answered: whether by yes, or why it stays unanswered *)
  | Recruit_for : timer * Vehicle_filter.t -> vehicle offer  (** that such a vehicle is there *)

(** The parts that no longer run. *)
type undoing =
  | Cancel of timer
  | Leave of vehicle  (** it was recruited, and is released if it is in B *)
  | Forget of timer list  (** the keys of these numbers *)
  | Do of ensured list  (** by an [ensure] that ends *)
  | Cut of t list  (** residuals that were cut off: their timers are cancelled, then their vehicles stop, and
                       those that were recruited are released; their ensured deeds are done *)

(** A further round that begins, of a [repeat] without a number of rounds: it has no end of its own, or its condition
    was asked and does not hold; or a watched task that runs again, by [retry()] of the handler at that place. *)
type round = Endless of again | Asked of again | Retried of site

(** The task that a handler runs in the place of its own: that task again, or the task that it gives. *)
type recovery = Anew | Instead of task

(** The state of a task after a step. [Handling]: its error goes to [handler], whose verdict decides the change. *)
type outcome =
  | Next of t
  | Finished
  | Failed of Fault.t
  | Handling of {
      handler : handler;
      fault : Fault.t;
      ignored : unit -> change;  (** after [ignore()] *)
      propagated : Fault.t -> change;  (** after [propagate()], or if the handler itself breaks *)
      recovered : recovery -> change;  (** if the handler may recover *)
    }

(** The change of a residual by a step. *)
and change = {
  label : Label.t;
  outcome : outcome;
  rules : Rule.t list;  (** the derivation, innermost rule first; after a handler, the rules that follow it *)
  timers : begun list;  (** that start, the questions that are put, and the keys of tasks that begin *)
  undone : undoing list;  (** in the order of the derivation, innermost rule first *)
  rounds : round list;  (** that begin: without these, every step leaves less of the residual *)
}

val keys_begun : change -> timer list
(** [keys_begun c] is the numbers of the keys of tasks that begin by [c]: N is without pairs of them afterwards. *)

val changes_shared : change -> bool
(** [changes_shared c] is whether [c] itself changes N or variables: keys begin or end, or something ensured is done. *)

type step = Step : { offer : 'reply offer; continue : 'reply -> change; around : surrounding list } -> step
(** [around] is the surroundings of the part that takes the step. *)

val steps : t -> step Seq.t
(** [steps r] is all that [r] can do, leftmost first, computed on demand. *)

val marked_steps : Branches.mark -> t -> step Seq.t
(** [marked_steps m r] is [steps r], without some of those of branches that do not have the mark [m]. *)

val among : surrounding list -> step -> step
(** [among around s] is [s], with [around] around what is around it. *)

val broken : step -> Fault.t -> change option
(** [broken s fault] is the change by [s] if it fails: if what it needs goes wrong, with [fault] if it runs code, or by
    WITHIN-CUT; [None] if it cannot fail. *)

(** {1:contexts Composition}

    The steps of a whole are those of its parts, with their changes composed by the rules of the parts' surroundings.
    [steps] is made so. The functions are public so that changes of single parts are composed in the same way. *)

val change_within : context -> change -> change
(** [change_within k c] is the change of [within k r] by a step of [r] that changes [r] by [c]: SEQ, ALLOF, UNTIL,
    DURING, WATCH. *)

val cuts : context list -> t -> step list
(** [cuts ks r] is the steps of [plug ks r] that are not steps of [r]: UNTIL-CUT, ASSURE-CUT, DURING-CUT and WITHIN-CUT
    of each of [ks], the innermost first. *)

val escaping : ?beside:ensured list list -> context list list -> step -> step
(** [escaping nests s] is [s] with its errors passed on. [s] is a step of a branch of a [|]. This [|] stands in the
    contexts at the head of [nests], as a branch of a [|] that stands in the next contexts, and so on. If the branch
    goes on or is over, all around it stays. An error leaves the [|] by PAR-ERR, passes through the contexts, and climbs
    on unless it is handled there. The other branches are not known here, so they are not in [undone], but for what
    they ensure: [beside], for the innermost [|] first. *)
