(** What code can tell of vehicles: found in a program without running it. Values are followed by what they may hold,
    whatever the order in which things happen. *)

open Dolphin_semantics

type t = {
  named : Core.site option;
  (** where code makes something of the name or the order of names of a vehicle, but to say it in a [message], [halt] or
      [assert]: puts it into a text, a key of a map or a question, sorts by it, asks for it, looks at an error's text *)
  spelled : Core.site option;
  (** where it puts into a text, but to say it, what a sensor shows, or compares that with a vehicle *)
  places : bool;  (** it depends on where vehicles are: [position], a [region] to pick in, inline plans to allocate *)
  batteries : bool;
  picks : bool;
  texts : string list;  (** all texts in it *)
}

val of_program : Core.program -> asked:Core.closure list -> t
(** [of_program p ~asked] is for [p] and conditions on it. *)

val computes : Core.expression -> bool
(** [computes e] is whether [e] is made of constants and operators alone. *)
