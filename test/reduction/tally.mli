(** The results of comparisons of reduced and plain searches, over many programs. *)

open Dolphin_explore

type t = private {
  mutable skipped : int;  (** programs with too many states *)
  mutable whole : int;  (** states of plain searches *)
  mutable reduced : int;  (** of reduced ones *)
  mutable smaller : int;  (** programs with fewer states by reduction *)
  broken : (Property.t, int) Hashtbl.t;  (** by how many programs *)
}

val create : unit -> t

val agrees : t -> (Agreement.t option, string) result -> bool
(** [agrees t found] counts what a comparison has [found] on an input of the usual seed; if it is an error, the property
    that is tested fails. *)

val print_broken : t -> unit

val check_broken : ?but:Property.t list -> t -> unit
(** [check_broken ~but t] fails unless each property is broken by some program, but [All_reached] and
    [but]. *)
