(** The output of [dolphin exec --runs]. *)

val time : float -> string
(** Seconds as {!Dolphin_time.Bounds.pp_time} has them. *)

val percent : float -> string
(** ["12.50 %"]. *)

val ending : Program_file.t -> Sampled_run.ending -> string
(** The ending in words, with the place of a fault. *)

val lines : columns:int -> Program_file.t -> Sampling.t -> string list
(** For people: the endings of runs with their numbers, their times, the outcomes of tasks, and the handlers that
    ran. *)

val print : Program_file.t -> Sampling.t -> unit
(** {!lines}, as wide as the terminal. *)

val to_json : Program_file.t -> Sampling.t -> Yojson.Safe.t
(** The same for programs; times in seconds. *)
