(** The functions of positions and areas. *)

val apply : string -> string option list -> Core.value list -> (Core.value, string) result
(** [apply name keys xs] is what the function [name], one of those that {!Builtins} knows as such, gives for the
    arguments [xs]; [keys] has the name of each that has one. An error says which argument is wrong, and what would be
    right. *)
