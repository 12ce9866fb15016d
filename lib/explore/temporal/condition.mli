(** Conditions on states, evaluated from outside of the program: expressions of the language over its global
    variables and functions. In addition, [running('plan')], [running('plan', 'vehicle')] and [bound('vehicle')]
    query A and B, and [poll(key: value)] queries N, as everywhere. A name of the program hides these two. *)

open Dolphin_semantics

type t

val of_string : Core.program -> string -> (t, string) result
(** [of_string p text] is the condition that [text] spells, or what is wrong with it in one sentence. *)

val closure : t -> Core.closure
(** Its code. Extra variables beyond the program's global ones stand for its queries of A and B. *)

val vehicles : t -> Core.vehicle list
(** Those that it asks for by name. *)

val to_string : t -> string
(** The text that {!of_string} read. *)

(** The value of a condition in a state. *)
type answer =
  | Holds
  | Fails
  | Not_yet  (** a variable that it names has no value yet *)
  | Broken of string  (** its code is faulty, or does something *)

val eval : Core.program -> World.t -> t -> Configuration.t -> answer
(** [eval p w c configuration] is the value of [c] in [configuration], whose deeds are undone. *)

val running : t -> (string * string option) list
(** The plans, each perhaps with a vehicle, of which it asks whether they run. Otherwise the answer is a function of the
    store, B and N. *)

val only_shared : t -> bool
(** Whether [running] is not asked. *)
