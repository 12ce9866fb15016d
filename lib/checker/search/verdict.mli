(** The verdict on a question about all runs, in one word. *)

type t =
  | Holds
  | Violated  (** by some run *)
  | Inconclusive  (** nothing violates it, as far as could be seen *)

val name : t -> string
(** ["holds"], ["violated"], ["inconclusive"]. *)
