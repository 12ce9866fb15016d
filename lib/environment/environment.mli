(** The outside of an explored program: the possible events of a configuration besides its own steps. Everything that
    [Transition] offers may happen in any order, restricted by {!options}. Readings of sensors are the world's, which
    may leave them open.

    {[
      open Dolphin_semantics
      open Dolphin_environment

      let program =
        let text = "v = pick { count 1 }" in
        let ast = Result.get_ok (Dolphin_syntax.Parse.program ~file:"a.dol" text) in
        fst (Result.get_ok (Elaborate.program ~source_name:"a.dol" ast))

      let world = Scenario_world.world Dolphin_scenario.Scenario.default
      let labels options =
        let rec go n c e =
          match List.of_seq (Environment.choices options program world e c) with
          | [ (t, e) ] when n > 0 -> go (n - 1) t.next e
          | choices -> List.map (fun ((t : Transition.t), _) -> Format.asprintf "%a" Label.pp t.label) choices
        in
        go 1 (Configuration.initial program) Environment.initial

      (* After the step to the pick, any vehicle may be picked. *)
      let () = assert (List.length (labels Environment.default) = 4)
    ]} *)

open Dolphin_semantics

(** How a platform task may end. *)
type ending = Succeeds | May_fail | Fails

(** Pairs that people or programs may post with one key. *)
type input = {
  key : string;
  rounds : Core.value list list;
  (** for the first time, the second and so on: the possible pairs then; the last item is for all later times. At
      least one item, each with at least one value *)
  times : int;  (** how often in one run, at most *)
  certain : bool;  (** as often as that, sooner or later; otherwise perhaps never *)
}

(** The ways in which awaited events may come out, and the events that come unasked. *)
type options = {
  endings : Core.vehicle -> string -> ending;
  (** of a vehicle's run of the plan with this name, without {!Faults} *)
  plans : string list;
  (** the names of plans whose [endings] may be others than those of all that are not named here *)
  may_be_late : Core.vehicle -> bool;  (** the vehicles that may be late, or missing, if any may *)
  answers : string -> string list list;
  (** by prompt, for the first time it is asked, the second and so on: the possible answers then. The last item is
      for all later times. Prompts without any stay unanswered. *)
  replies : string -> (Core.value, string) result list list;
  (** the same by the name of a call ({!Machine.name_of_call}): the supplier's possible replies, or the reason for
      none. Tasks come from the place of the call. Without any, the call fails ({!no_reply}). *)
  inputs : input list;  (** those with keys that the program does not declare do not count *)
  faults : Faults.t;
  most_faults : int option;
  (** how many faults one run may have, of all kinds together: failures of tasks that otherwise succeed, losses, and
      vehicles that are late or missing. Only with a number are they counted; interruptions are not *)
  who_is_lost_matters : bool;
  (** whether the program may look for vehicles after a loss. If not, it makes no difference who is lost, and it is not
      remembered unless losses are counted. *)
  recurring : World.assumption list list;
  (** assumptions on endless runs: each is that a choice which looks at the sensor again and again finds one of these
      again and again. No transition depends on them *)
}

exception Unclear of Fault.t
(** The outcomes of a step in an open world cannot be listed: see {!Transition.internal_all}. The exploration cannot
    go on. This is the one exception here that does not mean a broken invariant. It passes through the expansion of
    states, memoised steps included; callers handle it where the exploration ends. *)

val clear : ('a, Fault.t) result -> 'a
(** [clear (Ok x)] is [x].
    @raise Unclear *)

val default : options
(** Tasks succeed; there are no losses, late vehicles, answers, replies, posts or interruptions. *)

val ending : options -> Core.vehicle -> string -> ending
(** [ending o v name] is how [v] may end the plan of this name, faults included. *)

val forgetting_losses : options -> options
(** [forgetting_losses o] is [o] where it does not matter who is lost. *)

val failing : ?failures:int -> options -> options
(** [failing options] is [options] with failures of every task that may succeed, at most [failures] in one run. *)

val may_succeed : options -> Core.vehicle -> string -> bool
(** [may_succeed o v name] is whether [v] may end the plan of this name well. *)

val may_fail : options -> Core.vehicle -> string -> bool
(** Whether it may fail, or be lost. *)

(** {1:memory What the outside remembers} *)

type t

val initial : t
(** Before anything has happened. *)

val compare : t -> t -> int
(** A total order. *)

val hash : t -> int
(** Equal memories have equal hashes. *)

val lost : t -> Core.vehicle list
(** The vehicles whose connection was lost and of which nothing was heard since, in ascending order. *)

val late : t -> Core.vehicle list
(** The vehicles that were late, or missing, at some time, as far as that is remembered, in ascending order. *)

val spent : t -> int
(** How many faults there were, with [most_faults]; else 0. *)

val renamed : (Core.vehicle -> Core.vehicle) -> t -> t
(** [renamed f e] is [e] with each vehicle [v] in it as [f v]; [f] is injective. *)

(** Its value, as plain data. *)
type memory = {
  failed : int;
  losses : int;
  spent : int;  (** faults, with [most_faults] *)
  lost : Core.vehicle list;
  late : Core.vehicle list;
  asked : (string * int) list;  (** by prompt *)
  called : (string * int) list;  (** by the name of the call *)
  sent : (int * int) list;  (** by place among the inputs *)
}

val memory : t -> memory
(** The value of a memory, from which {!of_memory} makes it again. *)

val of_memory : memory -> t
(** [of_memory (memory e)] is [e]. *)

val without_contact : Core.vehicle list -> options * t -> options * t
(** [without_contact vs (o, e)] is [(o, e)] where the connections of [vs] are lost and nothing was heard of these
    vehicles since. They count as losses that [o.faults] had besides those that are still to come. *)

val without_faults : options * t -> options * t
(** [without_faults (o, e)] is [(o, e)] where no fault happens any more: vehicles that are lost stay so, and a limit on
    failures holds of those of plans that may fail by themselves. *)

val after : options -> Core.program -> Configuration.t -> Transition.event -> t -> t
(** [after o p c event e] is the memory after a real run had [event] in the configuration [c], with [e] before.
    Questions, calls and inputs are counted as in {!choices}; failures and losses are not, since the bounds of
    [o.faults] are on those that are still to come. *)

(** {1:happens What may happen} *)

val failure : string
(** The reason of failing tasks: ["failure"]. *)

val loss : string
(** Why it does where the connection is lost: ["connection lost"]. *)

val confirmations : options -> string -> (bool, string) result list
(** [confirmations o prompt] is the possible answers to the question of a task, whether yes: any of the answers that
    are given for [prompt]; without any, yes and no. If none of them is yes or no, the question stays unanswered. *)

val no_reply : string -> string
(** [no_reply call] is the reason why [call] fails without an entry in [replies]: the fleet's missing entry. *)

val task_ends : options -> t -> Core.vehicle -> Core.platform_task -> (Transition.event * t) list
(** [task_ends o e v p] is the events that may end [p] on [v]; each of them is among [task_ends o initial v p], perhaps
    with another memory. *)

val endings_remember : options -> bool
(** Whether the memory after an end that [task_ends] gives may differ from that before it although the task succeeds. *)

val inputs : options -> Core.program -> t -> (string * Core.value * t) list
(** [inputs o p e] is the possible posts, each pair with the memory after it. *)

val keys_of_inputs : options -> Core.program -> t -> string list
(** [keys_of_inputs o p e] is the keys of {!inputs}, each once, ascending. *)

val upcoming : options -> Core.program -> t -> (string * Core.value) list
(** [upcoming o p e] is all pairs that may be posted now or later. *)

val owes : options -> Core.program -> t -> bool
(** Whether some input is certain that has not come as often as it will. After the end of a run none comes. *)

(** A transition that may happen. *)
type choice = {
  transition : Transition.t;
  outside : t;  (** the memory after it *)
  on : Transition.event option;  (** the event that it answers; [None]: the program's own *)
}

val choices_on :
  ?alike:(Core.vehicle -> Core.vehicle option) -> options -> Core.program -> World.t -> t -> Configuration.t ->
  choice Seq.t
(** [choices_on o p w e c] is {!choices}, each with its event. *)

val choices :
  ?alike:(Core.vehicle -> Core.vehicle option) -> options -> Core.program -> World.t -> t -> Configuration.t ->
  (Transition.t * t) Seq.t
(** [choices o p w e c] is every transition of [c], computed on demand: its own, leftmost first, then those on events,
    in the order of [Transition.awaited], the inputs, and last the interruption, if there are any. The assumptions of a
    transition, on sensors and on present vehicles, are among its [assumed]. At a pick, of those that differ only by
    exchanging vehicles that are [alike] ({!Attendance.company}) one is given.
    @raise Unclear (each time it is gone through, after those of all other steps) if [w] is open and the outcomes of a
      step cannot be listed. *)

val choices_like :
  Transition.t -> options -> Core.program -> World.t -> t -> Configuration.t -> (Transition.t * t) Seq.t
(** [choices_like t o p w e c] is {!choices}, perhaps without some that bind other vehicles than [t] does: there may be
    so many of these that [t] is better looked for among the rest. *)

val find : ('choice -> bool) -> 'choice Seq.t -> 'choice option
(** [find p choices] is the first of [choices] for which [p] holds, if there is one. The others after it are not
    computed. *)

val may_interrupt : options -> Machine.t -> bool
(** [may_interrupt o m] is whether a person may interrupt a run whose script stands at [m]: a run is interrupted at
    most once. *)

val may_leave : options -> Core.program -> bool
(** [may_leave o p] is whether an interruption may come that makes [p] execute what it declares by [onInterrupt]. *)

val is_voluntary : Transition.t -> bool
(** Whether it is an interruption or an input. *)

val heard_of : Core.vehicle -> t -> t
(** [heard_of v e] is [e] after [v] was heard of: it is not lost. *)

val may_stay_away : options -> t -> Core.vehicle -> bool
(** [may_stay_away o e v] is whether [v], which is there, may never come to a [recruit]: it is lost, or may be late. *)

val may_all_stay_away : options -> t -> Core.vehicle list -> bool
(** [may_all_stay_away o e vs] is whether all of [vs] {!may_stay_away} together: no more of them are late for the first
    time than may be. *)

val only_recruits : options -> t -> Transition.t list -> bool
(** [only_recruits o e ts] is whether none of the transitions [ts] must happen: all are {!is_voluntary}, or wait for
    vehicles that may all stay away. *)

val is_stuck : options -> Core.program -> t -> (Transition.t * 'state) Seq.t -> bool
(** [is_stuck o p e choices] is whether [choices], those of a state with memory [e], are empty, or are interruptions
    and inputs that are not certain: neither need ever come. *)
