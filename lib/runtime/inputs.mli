(** The posts of people and programs while a run goes on, on their way to the driver. Order is kept. *)

open Dolphin_semantics

type t

val create : unit -> t
(** No item, and no question. *)

val post : t -> string -> Core.value -> bool Lwt.t
(** [post t k x] hands over the pair [k:x]. It resolves once the run has taken it, and the journal has it; to [false]
    if the run ended before, or does not declare the key. If [k] is the prompt of a question of a task, [x] answers
    it: to [false] if it is not open any more. *)

val questions : t -> string list
(** The prompts of the questions of tasks that stand. *)

val is_closed : t -> bool
(** Whether nothing is taken any more. *)

(** {1:driver For the driver} *)

(** The pair that is posted; {!tell} resolves [told]. *)
type item = { key : string; value : Core.value; told : bool Lwt.u }

val next : t -> item Lwt.t
(** [next t] is the next item. It may be cancelled, and then loses nothing. *)

val ask : t -> string list -> unit
(** [ask t prompts] makes [prompts] the questions that stand. *)

val tell : item -> bool -> unit
(** [tell item taken] resolves the promise of the poster. *)

val close : t -> unit
(** Nothing is taken any more. *)
