(** The rest of an executing task: its vehicles assigned, its finished parts dropped. Residuals are kept in normal form
    (nothing that is done remains; [>>] leans to the right, [|] is flat; an [allOf] with one branch left is a [oneOf]),
    so that tasks which behave alike are more often equal.

    {!Task_rules} has their steps. *)

open Core

(** A timer that [idle] or [during] starts, or a question that [confirm] puts, by its place in the executed task, from
    1. *)
type timer = int

val script_timer : timer
(** The timer of [pick] and [pause]: 0. *)

val alarm : timer
(** A timer that no program has: a driver's own, for a date. *)

(** The event that a timer waits for: that a number of seconds pass, or the answer to a question. *)
type wait = Time of float | Answer of string

(** A wait, or the key of a {!constructor-Fresh} by its number: these begin by activation. *)
type begun = Wait of timer * wait | Key of timer

type t =
  | Ready of platform_task * vehicle  (** about to start *)
  | Running of platform_task * vehicle
  | Action of closure
  | Condition of closure
  | Sequence of t * t list  (** the running part, which is not a [Sequence], and at least one part to come *)
  | Parallel of t Branches.t  (** at least two, none of them [Parallel] *)
  | All_of of t option * branch list
  (** the branch that runs and at least one other; or none, and at least two *)
  | One_of of branch list
  | Until of on_cut * closure * t
  | Idle of { timer : timer; seconds : float; site : site }
  | Confirm of { question : timer; prompt : string; site : site }  (** waits for yes *)
  | During of { on_cut : on_cut; timer : timer; duration : duration; started : bool; body : t }
  | Watch of t * handler
  | Repeat of { round : t option; again : again }
  (** the round that runs; [None] between two rounds, when the condition is to be asked *)

  | Made of { code : closure; given : value list; request : request }
  (** code that gives a task once its turn comes, with its arguments *)
  | Unallocated of { task : task; request : request }  (** a task that waits for vehicles *)
  | Hold of vehicle list * t  (** holds these vehicles, one at least, until it ends *)
  | Recruit of { number : timer; asked : Vehicle_filter.t; code : closure; place : timer; depth : int; site : site }
  (** waits for a vehicle; [place] and [depth] are of the {!type-request} for the task that [code] gives of it *)
  | Recruited of vehicle * t  (** has the vehicle, which is released when it ends *)
  | Fresh of timer list * t  (** has the keys of these numbers, for itself alone *)
  | Ensure of ensured list * t  (** does these, one at least, when it ends *)

(** A branch [when { guard } then body] of an [allOf] or [oneOf]. *)
and branch = { guard : closure; body : t }

(** The code that errors come to. If it may recover ({!Recovery}), [anew] is the watched task, and the vehicles that
    its copies may be given. *)
and handler = { code : closure; anew : (task * request) option }

(** How a [repeat] goes on: [left] rounds are to come, at least one, or no number of them; none once [until] holds;
    [each] is a round that is about to run; [site] is its place in the program. *)
and again = { left : int option; until : closure option; each : t; site : site }

and request = {
  allowed : vehicle list option;  (** by the [T[V]] around it; [None]: all of B *)
  place : timer;  (** its place in the executed task, among the timers *)
  depth : int;  (** how many closures made it, one in the task of the other *)
}
(** The vehicles that a task made at its turn may be given. *)

val compare : t -> t -> int
(** A total order, with {!equal} and {!hash}; code is compared by its place in the program and by its captured
    values. *)

val equal : t -> t -> bool
(** [equal r s] is [compare r s = 0]. *)

val hash : t -> int
(** Equal residuals have equal hashes. *)

val pp : Format.formatter -> t -> unit
(** A short text in the language's syntax. *)

(** {1:parts Parts}

    Traversals that need no rule of a constructor are functions of its parts, from left to right. *)

(** A part that is not a residual. *)
type leaf =
  | Plan of platform_task * vehicle
  | Code of closure  (** of an action, a condition, a guard, a duration *)
  | Handler of closure
  | Maker of closure  (** gives a task *)
  | Given of value  (** an argument of it, or a value of an [ensure] *)
  | Term of task  (** may become a residual *)
  | Held of vehicle  (** until the whole ends *)
  | Timer of timer  (** or the number of a question, a recruit, a key *)

val fold : begun:('a -> t -> 'a) -> later:('a -> t -> 'a) -> leaf:('a -> leaf -> 'a) -> 'a -> t -> 'a
(** [fold ~begun ~later ~leaf x r] folds over the parts of [r], without their own parts: [begun] of those that run if
    [r] does, [later] of those to come, which include each round of a [repeat]. *)

val parts : t -> t list
(** [parts r] is the residuals among the parts of [r]. *)

val fold_leaves : ('a -> leaf -> 'a) -> 'a -> t -> 'a
(** [fold_leaves f x r] folds [f] over the leaves of [r] and of all residuals in it. *)

val fold_all : ('a -> t -> 'a) -> 'a -> t -> 'a
(** [fold_all f x r] folds [f] over [r] and all residuals in it, from the outside in. *)

val fold_active : ('a -> t -> 'a) -> 'a -> t -> 'a
(** [fold_active f x r] folds [f] over [r] and the residuals in it that have begun, from the outside in. *)

(** A function for each kind of part; [vehicle] is also for the vehicles that a task made later may be given. *)
type mapper = {
  part : t -> t;
  code : closure -> closure;
  handler : closure -> closure;
  maker : closure -> closure;
  value : value -> value;
  term : task -> task;
  vehicle : vehicle -> vehicle;
}

val map : mapper -> t -> t
(** [map m r] is [r] with each part replaced by its image. Timers, plans and filters stay. The functions are applied
    once a part, from left to right. *)

(** {1:normal Normal forms} *)

val sequence : t -> t -> t
(** [sequence r r'] is [r >> r']. *)

val parallel : t list -> t
(** [parallel rs] is the residuals [rs], at least one, side by side. *)

val all_of : t option -> branch list -> t
(** [all_of running remaining] is the [allOf] whose branch [running] has begun; [remaining] are those to come. There
    is one at least. *)

val repeat : again -> t -> t
(** [repeat a r] is the [repeat] of which the round [r] runs, with [a.left] rounds to come: [r] for the last one. *)

val holding : vehicle list -> t -> t
(** [holding vs r] is [r], which holds [vs] until it ends. *)

val in_place : t Branches.place -> t -> t
(** [in_place p r] is the [|] of a branch at [p] and those beside it, with [r] in the place of the branch. *)

val without : t Branches.place -> t
(** [without p] is the branches beside [p], one at least. *)

val ensuring : ensured list -> t -> t
(** [ensuring ds r] is [r], which does [ds] when it ends. *)

val activate : t -> t * begun list
(** [activate r] is [r] about to run, and the timers, questions and keys that begin with it. A [during] whose time
    is given by code starts in a step of its own. *)

(** {1:active What is active} *)

val running : t -> vehicle list
(** [running r] is the vehicles that run a task of [r]. *)

val site_of_timer : timer -> t -> site option
(** [site_of_timer n r] is the place in the program of the [idle], [during] or [within] of [r] that has begun and whose
    timer is [n]. *)

val recruits : t -> vehicle list
(** [recruits r] is the vehicles that [r] has recruited and has still. *)

val ensures : t -> bool
(** [ensures r] is whether there is an [ensure] in [r], begun or to come; tasks that code would give are not seen. *)

val ensured : t -> ensured list
(** [ensured r] is the deeds of the end of [r] if it is cut off: of each [ensure] that has begun, the innermost
    first, and from left to right. *)

val waits : t -> (timer * wait) list
(** [waits r] is the timers of [r] that have started, and the questions that stand. *)

val awaits : Branches.mark -> t -> bool
(** [awaits m r] is whether [m] is a mark of a node of [r] that has begun. *)

val may_go_round : t -> bool
(** [may_go_round r] is whether [r] has a [repeat] without a number of rounds, code in the place of a task, which may
    make one, or a handler that may run its task again. Without these, every step leaves less. *)

(** {1:contexts Contexts}

    A residual that has begun stands in contexts. The contexts alone determine how a change of it becomes a change of
    the whole, not the parts beside it ({!Task_rules.change_within}); so its steps can be computed once. A [Parallel]
    is not a context: several of its branches have begun. *)

(** One layer around a running part. *)
type context =
  | In_sequence of t list  (** [_ >> t1 >> ... >> tn] *)
  | Branch_of of branch list  (** [allOf(_; bs)] *)
  | Body_until of on_cut * closure
  | Body_during of on_cut * timer * duration  (** the timer runs *)
  | In_watch of handler
  | Round_of of again
  | Holding of vehicle list
  | In_recruited of vehicle
  | With_keys of timer list
  | Ensuring of ensured list

val opened : t -> (context * t) option
(** [opened r] is the outermost context of [r], and its contents, if any part in it has begun. *)

val within : context -> t -> t
(** [within k r] is [r] in [k], in normal form. *)

val decompose : t -> context list * t
(** [decompose r] is all contexts of [r], the innermost first, and their contents: [plug ks r'] is [r] if [decompose
    r] is [(ks, r')]. *)

val plug : context list -> t -> t
(** [plug ks r] is [r] in the contexts [ks], the innermost first. *)

(** {1:held What is held} *)

val named : t -> vehicle list
(** [named r] is the vehicles that [r] names: that its platform tasks run on, those to come included, or that it holds;
    in alphabetical order. *)

val makes_tasks : t -> bool
(** [makes_tasks r] is whether tasks are made at their turn in [r], were made, or are to be; by handlers too. *)

(** The surroundings of a residual: the parts beside it in a [Parallel], or a context. Lists begin with the
    outermost. *)
type surrounding =
  | Beside of t list Lazy.t
  | Inside of context
  | Around of t list  (** the context of the step itself, or the one that it cuts *)

val held : surrounding list -> vehicle list
(** [held around] is the vehicles that are held from the residual in [around]: those named beside it. Its
    continuation, the other branches of an [allOf] and the task that holds it are never active beside it, so they
    hold nothing from it. *)

val needed_around : surrounding list -> vehicle list
(** [needed_around around] is the vehicles that [around] needs: those named beside it, or in parts to come. Contexts
    that only hold them around it do not need them. *)

val named_around : surrounding list -> vehicle list
(** [named_around around] is the vehicles that [around] names, beside or around. *)

val recruited_for : surrounding list -> vehicle list
(** [recruited_for around] is the vehicles that were recruited for the residual in [around]. *)

val beyond_watches : surrounding list -> surrounding list list
(** [beyond_watches around] is the surroundings of each [watch] of [around], the innermost [watch] first. *)

val inside_watches : surrounding list -> t list Lazy.t list
(** [inside_watches around] is the part of [around] inside of each of its [watch]es, the innermost [watch] first: the
    part cut off by an error that reaches it. *)

val allocation_around : surrounding list -> platform_task Vehicle_map.t
(** [allocation_around around] is the tasks that run in the parts that [around] names. *)

val timers_around : surrounding list -> timer list
(** [timers_around around] is the timers that [around] names, those to come included. *)

val hole : t
(** Stands for the inside of contexts: it names no vehicle and no timer. *)

val key : timer -> string
(** [key n] is the key of N that a {!constructor-Fresh} with the number [n] has: ["#n"]. *)

val key_prefix : string
(** The first characters of all these keys. *)

val is_key : string -> bool
(** [is_key k] is whether [k] is [key n] for some [n]. *)

val fresh_timers : timer -> timer list -> timer Seq.t
(** [fresh_timers place used] is new timers, without end, for a task made at [place], where those [used] are taken. They
    differ from all timers of tasks made at other places, and of the executed task. *)
