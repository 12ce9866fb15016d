(** A walk: a person takes the steps of a run, one by one, by lines that are typed. *)

val run :
  read:(string -> string option) -> print:(string -> unit) -> columns:(unit -> int) -> Program_file.t -> Fleet_file.t ->
  answers:string list -> faults:Dolphin_environment.Faults.t -> trace:string option -> (unit, Error.t) result
(** [run ~read ~print ~columns program fleet ~answers ~faults ~trace] lets a person walk through the runs of [program]
    in the world of [fleet], as [dolphin explore] has it, until [read prompt] is [None] or asks to leave. [print] gets
    lines that are made for [columns ()] characters. With [trace], the run that this file records lies ahead. The error
    is {!Error.Bad_input}: it records none, or not one of this program in this world. *)

val help : (string * string) list
(** The commands of a walk. *)
