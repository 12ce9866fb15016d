(** Searches that need nothing of each other, shared out among processes. *)

module Limits = Dolphin_checker.Limits

val all :
  workers:int -> started:float -> Limits.t -> Limits.measures -> phase:string -> count:int -> (Limits.t -> int -> 'a) ->
  (int * 'a) list * Limits.bound option
(** [all ~workers ~started limits m ~phase ~count f] is [f limits' 0] to [f limits' (count - 1)], each with its
    number, and why some are missing, if so: an interruption, or a process ended early. Several processes work them
    out, at most [workers], but this one alone if there is but one, if memory has a bound, which none of several
    would know, or if the system makes no other. [limits'] are [limits], of several processes without reports: this
    one reports [phase], and the number of finished ones among [count], of [started] then, with [m]. The results of
    [f] are as in {!Dolphin_processes.Workers.start}. *)
