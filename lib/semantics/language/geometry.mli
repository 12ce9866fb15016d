(** The functions of positions and areas. *)

val apply : string -> string option list -> Core.value list -> (Core.value, string) result
(** [apply name keys xs] is the value of the function [name], one of those that {!Builtins} knows as such, for the
    arguments [xs]; [keys] has the name of each that has one. An error names the wrong argument, and the right range. *)
