(** Properties and methods of values that need no code of the program: [v.getId()], [xs.size()], [p.latitude]. Those
    that call a closure, such as [xs.each { ... }], belong to {!Machine}. *)

open Core

val one_vehicle : World.t -> vehicle list -> (World.vehicle_state, string) result
(** [one_vehicle w vs] is the known state of the only vehicle of [vs]. *)

val property : World.t -> value -> string -> (value, string) result
(** [property w x name] is [x.name]. Of a map it is the value of the key, null without it; of a vehicle, its value in
    world [w], less its sensors; of a number, the number in that unit. *)

val call : World.t -> value -> string -> value list -> (value, string) result
(** [call w x name arguments] is [x.name(arguments)]. *)

val may_have : value -> string -> bool
(** [may_have x name] is false if no value of the kind of [x] has a property or a method [name]. *)

val like : value -> string -> string option
(** [like x name] is the member of [x] whose name is most like [name], if one is. *)

val updates : string -> bool
(** [updates name] is whether method [name] changes the variable that it is called on, as [xs.add(x)] does. The value
    of {!call} is then the variable's new value. *)
