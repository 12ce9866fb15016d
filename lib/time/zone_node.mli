(** States of runs with time without the values of their clocks, and how zones of these become others. docs/time.md has
    the reasons. *)

(** A step, with the inert items after it, and those of them that have begun with it. *)
type arrow = {
  step : Clocked.step;
  inert : Inert.item list;
  begun : Inert.item list;
  spelled : Canonical_state.execution -> Canonical_state.spelled;
  (** its successor, as {!Successors.type-successor} has it *)
}

(** Of the inert ends to come, the {e rest}: whether the last one is decided. *)
type rest = No_rest | Unsaid | Said

type t = private {
  state : Clocked.state;
  execution : Canonical_state.execution option;  (** if it stands for all states that are alike *)
  items : Clocked.item list;  (** the awaited events, in the order of {!Canonical_state.type-form} *)
  rest : rest;
  inert : Inert.item list;
  follows : (arrow list * (Clocked.item * int) list) Lazy.t;
  clocks : (Clocked.item * int) list;  (** waits that began at one time share one clock *)
  rest_clock : int option;  (** since when the last of the rest is over: less than 0 as it is to come *)
  mutable here : int list;  (** the numbers of the states of a search that are here *)
  mutable wider : (t * (Zone.t -> Zone.t)) list;
  (** the places of the same state in which fewer waits share clocks, each with what makes zones of this one those of
      it *)
  mutable narrower : (t * (Zone.t -> Zone.t)) list;  (** those of which it is a wider one *)
}

type places
(** The places of one search, each once. Mutable. *)

exception Broken
(** Something that was taken for inert is not, or for alike. *)

val places : Successors.t -> filled:(Zone.t -> Zone.t) -> note:(Clocked.state -> unit) -> places
(** [places successors ~filled ~note] has no place yet; [note] is called with the state of each new one, and zones are
    [filled]. Zones have a clock for the course of [successors] besides. *)

val course_item : places -> Clocked.item option
(** The purpose of the course's clock. *)

val fresh : places -> Clocked.state -> Clocked.step -> Clocked.item list
(** [fresh ps s step] is the waits that begin with [step] of [s], the course included if it turns. *)

val successors : places -> Successors.t
(** The successors of {!places}. *)

val add : t -> int -> unit
(** [add p n] notes that the state number [n] of a search is in [p]. *)

val remove : t -> int -> unit
(** [remove p n] undoes [add p n]. *)

val check_dates : places -> unit
(** Whether code does no more with the date than is known here.
    @raise Dolphin_checker.Limits.Stop if it does *)

val arrows : places -> t -> arrow list
(** [arrows ps p] is the steps of [p] that are followed.
    @raise Dolphin_checker.Limits.Stop
    @raise Broken *)

val steps : places -> t -> Clocked.step list
(** [steps ps p] is the steps of {!arrows}. *)

val followed : places -> Clocked.state -> Clocked.step list
(** [followed ps s] is the steps of [s] that are not inert ends. *)

(** {1:zones Zones} *)

val settled : places -> t -> Zone.t -> Zone.t option
(** [settled ps p z] is [z] after time has passed in [p], filled. *)

val enabling : t -> Zone.t -> Clocked.step -> Zone.t option
(** [enabling p z s] is those valuations of [z] in which [s] may be taken. *)

val reached :
  places -> clocks:(Clocked.item * int) list -> rest_clock:int option -> fresh:Clocked.item list -> has_rest:bool ->
  Canonical_state.spelled option -> Clocked.state -> Inert.item list -> Zone.t -> rest -> t * Clocked.item list * Zone.t
(** [reached ps ~clocks ~rest_clock ~fresh ~has_rest spelled s inert z rest] is the place of [s]; the awaited events
    of [s], in the order of the place's [items]; and the value of [z] there, if [fresh] begins, and the clocks were
    those of [clocks] and [rest_clock]. [has_rest] is whether [rest] is not [No_rest]: without [rest], it is the work
    that is the same for all decisions about it. *)

(** {1:rest The rest} *)

val lasts : t -> Inert.item list -> (Clocked.item option * rest) list
(** [lasts p begun] is those of [begun], which begin with a step of [p], that may be the last, and the decision after
    it. *)

val with_begun : t -> Inert.item list -> Clocked.item option -> Zone.t -> Zone.t option
(** [with_begun p begun last z] is those valuations in which the last end of the rest is not before that of any of
    [begun], and that of [last]. *)

val ends_of_rest : places -> Clocked.state -> Clocked.step list
(** [ends_of_rest ps s] is the ends of all that is inert in [s]. *)

val ends_now : int -> Zone.t -> (Zone.t * bool) option
(** [ends_now clock z] is those valuations in which the rest, with this clock, is over; [false]. *)

val ends_later : int -> Zone.t -> (Zone.t * bool) option
(** [ends_later clock z] is the others, as it is over; [true]. *)

(** {1:executions Executions} *)

val check_left : places -> t -> Clocked.state -> unit
(** [check_left ps p s] looks whether [s], to which a step of [p] leads, is the same for all states that are alike.
    @raise Broken *)

val execution_after : places -> t -> Clocked.state -> Canonical_state.execution option
(** [execution_after ps p s] is the execution of [s], to which a step of [p] leads.
    @raise Broken *)
