(** What people and programs post while a run goes on, on its way to the driver. Order is kept. *)

open Dolphin_semantics

type t

val create : unit -> t

val post : t -> string -> Core.value -> bool Lwt.t
(** [post t k x] hands over the pair [k:x]. It resolves once the run has taken it, and the journal has it; to [false] if
    the run ended before, or does not declare the key. *)

(** {1:driver For the driver} *)

type item = { key : string; value : Core.value; told : bool Lwt.u }

val next : t -> item Lwt.t
(** [next t] is the next item. It may be cancelled, and then loses nothing. *)

val tell : item -> bool -> unit
(** [tell item taken] resolves the promise of who posted it. *)

val close : t -> unit
(** Nothing is taken any more. *)
