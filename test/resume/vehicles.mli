(** The vehicles of the kill tests: a process of its own. *)

val start : port:int -> log:string -> int
(** [start ~port ~log] is the process; the discovery ports are the five from [port] on, and data ports come after
    them. The activities of the vehicles are in the file [log]. *)

val started : string -> string list
(** [started log] is the plans that were started, by name, as often as they were. *)

val faults : string -> string list
(** Unwanted activities of the vehicles: plans that took another's place, or failed, or were stopped but for
    {!Mission.stopped}. *)
