(** Flow of names: whether a step of a program may depend on the name of a vehicle. An analysis of non-interference,
    made without running the program: it follows which values may contain what, in whatever order things happen. *)

open Dolphin_semantics

type t = {
  names : Core.site option;
  (** code that uses a vehicle's name, or the order of names, for more than printing it in a [message], [halt] or
      [assert]: in a text, as a key of a map or in a question, for sorting, in a comparison, or through an error's
      text *)
  readings : Core.site option;
  (** code that puts a sensor's reading into a text, except for printing, or compares it with a vehicle *)
  places : bool;
  (** whether steps depend on positions of vehicles: [position], a [region] to pick in, allocation of inline plans *)
  sensors : bool;  (** whether they depend on other sensor readings: batteries, speeds, links, measurements *)
  abilities : bool;  (** whether they depend on the speeds of vehicles and on their battery consumption *)
  picks : bool;  (** whether there is a [pick] or a [recruit] *)
  leaks : bool;  (** whether a key of some [fresh] may be posted as a value, or assigned to a variable *)
  texts : string list;  (** all texts in the program *)
}

val of_program : Core.program -> asked:Core.closure list -> t
(** [of_program p ~asked] is for [p] and conditions on its states. *)

val computes : Core.expression -> bool
(** [computes e] is whether [e] is made of constants and operators alone. *)
