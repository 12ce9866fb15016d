(** The effects of the language's procedures: [task], [post], [consume], [battery], [Math.sqrt] ... *)

open Core

val apply : Code.context -> site -> builtin -> value list -> Code.outcome
(** [apply context site procedure arguments] is the result of [procedure]. It is called at [site], which platform
    tasks made there remember. *)

val given_pairs : string option list -> value list -> ((string * value) list, value) result
(** [given_pairs keys xs] is the pairs of [post], [consume] or [poll], with their values as they are given, or the
    argument that is not a key. *)

val blocking : Code.context -> string -> Code.request -> Code.outcome
(** [blocking context name request] waits for [request] in the script, and is a fault elsewhere, where [name] cannot
    stand. *)

val rounds : value -> (int, string) result
(** [rounds x] is the number of rounds of a [repeat] with the value [x]. *)

val spins : string
(** The fault of an endless [repeat] whose task surely never waits. *)

val of_result : (value, string) result -> Code.outcome
(** The value, or the text of the fault. *)

val sense : Code.context -> Reading.subject -> vehicle list -> Code.outcome
(** [sense x subject vs] is the reading of that sensor of the only vehicle of [vs]. *)

val rest : Code.context -> platform_task -> vehicle list -> Code.outcome
(** [rest c p vs] is the rest of [p] for the only vehicle of [vs] ({!Rest}). *)

val travel : Code.context -> platform_task -> Travel.quantity -> vehicle list -> Code.outcome
(** [travel x p q vs] is [q] of [p] for the only vehicle of [vs], from its place. *)
