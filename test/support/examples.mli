(** The programs in [examples/], from the folders of tests that are two below the root. *)

val folder : string

val names : unit -> string list
(** Of all programs, without their ending, in alphabetical order. *)

val with_fleets : unit -> string list
(** Of those that have a fleet of their own. *)
