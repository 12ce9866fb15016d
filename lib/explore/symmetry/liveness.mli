(** Variables that nothing reads any more: whoever forgets what they hold goes on as before. *)

open Dolphin_semantics

type t

val of_program : Core.program -> asked:Core.closure list -> t
(** [of_program p ~asked] is for [p] and conditions that may be asked at any time. *)

val forget : t -> (Core.value -> bool) -> Configuration.t -> Configuration.t
(** [forget l is_sought c] is [c] with [Null] in place of what variables and locals hold, and loops have gone through,
    where [is_sought] says so and nothing reads it before it is assigned anew: whatever happens, if code that is
    answered to [ask] reads no variables. *)
