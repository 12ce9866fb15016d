(** Whether a handler may do more than to settle its error: run the watched task again, or another one in its place.
    It is known from the handler's text alone, and never denied of a handler that does. *)

open Core

val may_retry : lambda -> bool
(** [may_retry h] is whether [retry()] is in the code of [h]. *)

val may_give : lambda -> bool
(** [may_give h] is whether the value of [h] may be a task. *)

val possible : lambda -> bool
(** [possible h] is [may_retry h || may_give h]. *)
