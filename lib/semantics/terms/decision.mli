(** Results that may depend on values that a world leaves open, as trees of decisions. In a closed world all is
    {!Decided}. *)

type 'a t =
  | Decided of 'a
  | Open of (World.assumption * 'a t Lazy.t) list  (** by the assumption, which is one of these *)
  | Unclear of Fault.t  (** more than a comparison depends on a reading: the results cannot be listed *)

val ask : World.t -> World.question -> (World.t -> 'a t) -> 'a t
(** [ask w q f] is [f] of [w] with each answer to [q] supposed. *)

val look : World.t -> (World.t -> ('a, World.question) result) -> 'a t
(** [look w f] is [f w], with its questions asked one after the other. *)

val map : ('a -> 'b) -> 'a t -> 'b t
(** [map f d] is [d] with [f x] for each result [x]. *)

val bind : 'a t -> ('a -> 'b t) -> 'b t
(** [bind d f] is [d] with the decisions of [f x] in the place of each result [x]. *)

val leaves : 'a t -> (World.assumption list * ('a, Fault.t) result) Seq.t
(** [leaves d] is all results of [d], computed on demand, each with its assumptions; an error where they are unclear. *)

val cases : 'a t -> ((World.assumption list * 'a) list, Fault.t) result
(** [cases d] is {!leaves} of [d] all at once, or its first error. *)

val outcomes : equal:('a -> 'a -> bool) -> 'a option t -> ((World.assumption list list * 'a) list, Fault.t) result
(** [outcomes ~equal d] is the results in {!cases} without duplicates, each with the assumptions of all of its cases, at
    least one. If every case has the same result, it has one case, which assumes nothing. *)
