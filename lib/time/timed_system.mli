(** Runs with time as a transition system for {!Dolphin_checker.Breadth_first}: a state is a {!Clocked.state} with a
    zone of its clocks. docs/time.md shows why the results are exact. *)

open Dolphin_semantics

(** The question: latest dates, or earliest dates. Dates that do not matter to it are filled up, so that more states
    include each other. *)
type goal = Latest | Earliest

include Dolphin_checker.System.S with type via = unit and type property = unit

exception Broken
(** An event taken for inert is not ({!Inert}), or one taken for alike ({!Canonical_state}): the results so far do not
    count. *)

(** As {!Successors.reduction}. *)
type reduction = Successors.reduction = Nothing | Inert_ends | Inert_ends_and_canonical_states

val create : ?working:bool -> ?start:Clocked.state -> goal -> Successors.t -> t
(** Runs go on from [start], by default {!Clocked.initial}. [working] is whether there are {!edges}, by default not;
    with a course, there are too, each with its {!type-passage}. *)

(** {1:dates Dates} *)

(** A date in milliseconds since the start. *)
type date = At of int | Unbounded

(** The events of a task. *)
type moment = Happening.moment = Starts | Ends | Fails | Stopped

val moment_name : moment -> string
(** In lower case: ["starts"]. *)

(** As {!Happening.task}. *)
type task = Happening.task = { name : string; vehicle : Core.vehicle; site : Core.site }

val tasks : t -> (task * (moment * date) list) list
(** When the tasks that run in some run do what, at the earliest or at the latest: by the order in which they were
    found. *)

(** How runs end. *)
type ending = Completed | Halted | Failed | Interrupted

val ending_name : ending -> string
(** In lower case: ["completed"]. *)

val endings : t -> (ending * (date * int)) list
(** The ends of runs, with the number of the state there. *)

(** {1:forever Runs without end}

    Looked for with the goal [Latest]. *)

type cycle = {
  from : int;  (** the state from which the run goes round again and again *)
  last : int;  (** the state before it comes back *)
  back : Clocked.step;  (** the step back *)
  in_no_time : bool;  (** whether no time need pass *)
}

val cycle : t -> cycle option
(** The cycle of a run without end, if one was found; one that takes no time before others. *)

val stuck : t -> int option
(** The first state in which nothing happens any more although the run is not over. *)

val unknown : t -> Clocked.pending list
(** The awaited events of unknown duration: each once. *)

(** {1:runs Runs} *)

(** How one state leads to another. *)
type move =
  | Step of {
      step : Clocked.step;
      begun : Inert.item list;  (** the inert items from here on *)
      last : Clocked.item option;  (** which of them is the last of the rest to end, if it is one of them *)
      items : Clocked.item list;  (** the awaited events then, in the order of {!Canonical_state.type-form} *)
    }
  | Rest of {
      steps : Clocked.step list;  (** all that is inert ends, in any order *)
      later : bool;  (** whether at the last end of it, and not at once *)
    }

(** A move to the state whose representative is [into]. *)
type arrival = {
  move : move;
  into : Clocked.state;
  items : Clocked.item list;  (** of [into], in that order *)
  execution : Canonical_state.execution option;  (** if states that are alike are taken for one *)
}

val path : t -> int -> arrival list
(** [path t n] leads to state [n]. *)

(** The course that is observed, until a move. *)
type passage = {
  may_do : Dolphin_scenario.Battery.doing list;
  least : int;  (** its least duration in milliseconds *)
  most : int option;  (** and at the most; [None]: no bound *)
  turns : bool;  (** whether the move turns it *)
  seen : Course.range;  (** the battery's values if the move is made *)
  binds : bool;  (** whether its vehicle is bound or released with it in the course of the run *)
}

(** A move from one state to a state represented by another, and the time that vehicles were under way with the tasks
    that it ends. *)
type edge = { source : int; target : int; by : move; working : Working.t; passage : passage option }

val edges : t -> edge list option
(** All of them: each run of the program goes along some, from state 0. [None] if they were not asked for, or are more
    than a million. *)

val along : t -> edge list -> arrival list
(** [along t edges] is the moves along [edges], which are one after the other. If a state stands for others, possibly
    no run takes them all. *)

val ends : t -> (int * date) list
(** The states in which runs are over, each with its date. *)

val count : t -> int
(** The number of states of which {!state} knows. *)

val state : t -> int -> Clocked.state
(** [state t n] is the state number [n], below {!count}. *)

(** The course that is observed, in a state. *)
type stay = {
  may_do : Dolphin_scenario.Battery.doing list;
  most : int option;  (** its greatest duration in milliseconds, to the end of the time that is spent there *)
  waited : float;  (** {!Course.waited} *)
}

val course : t -> Course.t option
(** The course of {!create}. *)

val stay : t -> int -> stay option
(** [stay t n] is for state [n]; [None]: nothing is observed. *)

val deadlines : t -> (Core.site * (date * arrival list) option) list
(** The [within] that begin in some run, by their places, each with the earliest or latest date at which it is
    missed, and the moves that lead there; [None]: never. *)

val start : t -> Clocked.state
(** The state from which runs go on. *)

val is_reduced : t -> bool
(** Whether anything was inert, or states might be alike. *)

val successors : t -> Successors.t
(** The successors of {!create}. *)

val places : t -> Zone_node.places
(** The places of the search. *)
