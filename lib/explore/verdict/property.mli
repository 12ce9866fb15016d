(** Requirements on all runs of a program. *)

open Dolphin_semantics

type t =
  | No_deadlock  (** some transition is possible until the program ends *)
  | Termination
  (** every fair run ends: each running task ends at some time, each timer expires, and no step of the program that
      stays possible is put off without end *)
  | No_error  (** no fault, and no error of a task, is left to end the program *)
  | Assertions  (** no assertion fails *)
  | Vehicles  (** every [pick] gets its vehicles *)
  | Allocation  (** every [execute] gets its vehicles *)
  | No_halt  (** [halt] is not called *)
  | No_leftover  (** no tuples are left when the program completes, but of keys that it declares by [input] *)
  | All_reached  (** every task and every piece of code inside of tasks is used by some run *)
  | Invariant of string  (** this {!Condition} holds in every state *)
  | Formula of string  (** this formula of temporal logic holds of every run *)
  | Apart of string
  (** plans whose ways come nearer to each other than this fence lets vehicles never run side by side *)

val all : t list
(** Those that need not be given, in this order. *)

val name : t -> string
(** A short phrase: ["no deadlock"]. *)

val question : t -> string
(** The meaning of a violation, in a sentence without a full stop. *)

val is_of_fair_runs : t -> bool
(** Whether it is about fair runs, so that the kind of fairness counts. *)

val pp : Format.formatter -> t -> unit
(** {!name}. *)

val broken_by_end : Core.program -> Rule.t list -> Configuration.t -> t option
(** [broken_by_end program rules c] is the property of [program] violated by a run that reaches [c] by a transition
    with these rules, if [c] is an end. *)
