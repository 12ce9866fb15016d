(** A transition, as journals have it: its visible parts, as plain texts. *)

open Dolphin_semantics
module Location = Dolphin_syntax.Location

(** The place of a message in the program. *)
type place = {
  file : string option;  (** one that the program includes, seen from the program's folder; [None]: the program *)
  line : int;
  column : int;
}

val place_of : Core.program -> Location.t -> place
(** [place_of p at] is the place [at] of [p]. *)

val text_of_place : place -> string
(** ["3:5"], ["lib/areas.dol:3:5"]. *)

type t = {
  rules : string list;  (** the derivation, from the axiom outwards *)
  label : string;
  at : place option;  (** of the code that takes it *)
  choice : int;  (** see {!section:choice} *)
  allocated : (string * string option) list;  (** changes of A: the vehicle's task now, or none *)
  bound : string list;  (** that joined B *)
  released : string list;  (** that left it *)
  posted : string list;  (** pairs ["k:x"] of N that are new, by key and value *)
  consumed : string list;  (** pairs of N that are gone *)
  requests : Request.t list;
}

(** {1:choice Choices}

    Of several transitions that are enabled and look the same, [choice] is how many there are to the left of the one
    that is meant. It is 0, and left out of the journal, if the leftmost is taken, as the runtime does. *)

val of_transition : Core.program -> Configuration.t -> Transition.t -> t
(** [of_transition p c t] is [t], taken from [c]. *)

val same : places:bool -> t -> t -> bool
(** [same ~places s s'] is whether [s] and [s'] are equal except for [choice], and unless [places] for [at]; of
    [at] line and column count. *)

val difference : places:bool -> t -> t -> string option
(** [difference ~places expected found] is the difference if [found] is not {!same} as [expected], in a sentence
    without a full stop. *)

val members : t -> Dolphin_json.Field.members
(** As journals have it. *)

val fields : (t, t) Dolphin_json.Codec.fields
(** The members that a step is written as. *)
