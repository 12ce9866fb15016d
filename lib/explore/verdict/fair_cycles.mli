(** Endless runs of a [repeat] without a number of rounds: which of them are fair, and which of those are intended.
    docs/explorer.md defines and proves it. *)

(** A cycle to be shown: states, from the initial one, and from the last of these around to it. *)
type lasso = { stem : int list; around : int list }

type verdict =
  | Ends  (** every fair run ends *)
  | Goes_on of lasso  (** a fair run is endless but neither begins rounds of an endless [repeat] again and again, nor
                          restarts a task *)
  | Spins of lasso  (** an endless run without any event *)
  | By_design of {
      repeats : Dolphin_semantics.Core.site list;
      retries : Dolphin_semantics.Core.site list;
      left_by : string list;
    }
  (** all endless fair runs are rounds of the endless [repeats], or use [retry()] of handlers; they may be [left_by]
      these events *)
  | Unsure  (** only a search of all states decides: partial order reduction omitted steps *)

(** A verdict, and the assumptions on readings that it needs: a run without them is worse. *)
type judgement = { verdict : verdict; needs : Dolphin_semantics.World.assumption list list }

val judge :
  ?strong:bool ->
  Dolphin_semantics.Core.program -> State_graph.t -> all:bool ->
  assumed:Dolphin_semantics.World.assumption list list -> judgement
(** [judge p g ~all ~assumed] is about all runs of [p] that meet [assumed], as of
    {!Dolphin_environment.Environment.options}, [g] being searched; [all] is whether no steps were left out in it. Then
    it is [Unsure] only where symmetry was used. With [strong], [false] by default, runs are left out on which the
    end of a plan, or a step that only an event can prevent, is possible infinitely often and taken finitely often.
    @raise Dolphin_checker.Limits.Stop *)

(** Assumptions on readings, and whether strong fairness is needed besides. *)
type help = { recurring : Dolphin_semantics.World.assumption list list; strong : bool }

(** What {!helpful} finds. *)
type advice =
  | Help of help
  | No_help  (** none is known *)
  | In_more_states  (** none is found in this graph, but in one of all states there may be some *)

val helpful :
  ?strong:bool ->
  Dolphin_semantics.Core.program -> State_graph.t -> all:bool ->
  assumed:Dolphin_semantics.World.assumption list list -> advice
(** [helpful p g ~all ~assumed] is assumptions with which every fair run would end, where {!judge} with [strong] finds
    one that does not; as few as were found.
    @raise Dolphin_checker.Limits.Stop *)

val may_go_round : Dolphin_semantics.Core.program -> State_graph.t -> lasso -> bool
(** Whether some run repeats the lasso without end: its looks at sensors and the date do not contradict each other
    without any time in between ({!Looks}). *)

val violation :
  ?strong:bool ->
  Dolphin_semantics.Core.program ->
  State_graph.t ->
  Dolphin_ltl.Monitor.t ->
  fair:bool ->
  assumed:Dolphin_semantics.World.assumption list list ->
  Dolphin_checker.Breadth_first.violation option * Dolphin_semantics.World.assumption list list
(** [violation p g m ~fair ~assumed] is a cycle that a run of [p] may repeat without end, the runs around it accepted by
    [m], and if [fair], they are fair and meet [assumed], or are without any event. Without such a cycle it has the
    assumptions without which there would be one. [g] has been searched with [m], with no reduction but the symmetry of
    vehicles, and with that only if [p] reads neither sensors nor the date and nothing is [assumed].
    @raise Dolphin_checker.Limits.Stop *)
