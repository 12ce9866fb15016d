(** How far the searches of commands go: as they are asked to, and no further than this machine and this process may. *)

val make :
  ?max_states:int -> ?max_depth:int -> ?max_memory:int -> ?timeout:float -> interrupted:(unit -> bool) ->
  progress:(Dolphin_checker.Limits.progress -> unit) -> unit -> Dolphin_checker.Limits.t
(** As {!Dolphin_checker.Limits.t} has them: bytes, and seconds of the system's clock. *)
