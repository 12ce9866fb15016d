(** Whether a reduced search finds what the plain one finds. *)

open Dolphin_semantics
open Dolphin_explore

type t = {
  whole : int;  (** states *)
  reduced : int;
  broken : Property.t list;
}

val check : ?limit:int -> Environment.options -> Core.program -> World.t -> (t option, string) result
(** [check o p w] is an error unless both searches find the same properties broken, the same code unreached, and each
    run that the reduced one shows is one of the semantics that ends as it should; and unless executing tasks come to the
    same in both: to the same configurations of the script, the same deadlocks, the same halts and failures. [None] if the
    program has more than [limit] states. *)
