(** Dead variables: their values are not read before the next assignment. A configuration that forgets it goes on as
    before. *)

open Dolphin_semantics

type t

val of_program : Core.program -> asked:Core.closure list -> t
(** [of_program p ~asked] is the liveness of the variables of [p], where the conditions [asked] may be evaluated at
    any time. *)

val forget : t -> (Core.value -> bool) -> Configuration.t -> Configuration.t
(** [forget l is_sought c] is [c] with [Null] in place of each value with [is_sought] that a dead variable or local
    holds, or that a loop has gone past. This is so whatever happens, provided that code that is answered to [ask] reads
    no variables. *)

val may_call : Core.operation -> bool
(** Whether the operation may run code of functions, closures or tasks. *)
