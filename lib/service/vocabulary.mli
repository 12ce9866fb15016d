(** The meaning of the language's names: the short form of the reference manual, for editors. *)

(** The kind of a word, for editors. *)
type kind = Word | Procedure | Block | Setting | Maneuver | Member | Constant | Fleet_word

(** The entry of a word. *)
type entry = {
  name : string;
  kind : kind;
  form : string;  (** How it is written: ["during D run T"]. *)
  text : string;  (** Its meaning, in a sentence or two. *)
}

val words : entry list
(** The words of the constructs. *)

val procedures : entry list
(** The procedures that every program has. *)

val blocks : entry list
(** The words that open a block of settings. *)

val settings : Dolphin_syntax.Ast.builder -> entry list
(** The settings of a block, and the maneuvers of an inline plan. *)

val members : entry list
(** Properties and methods of values. *)

val units : entry list
(** Units of numbers. *)

val constants : entry list
(** Constants by their full names, and the functions of [Math]. *)

val fleet_entries : entry list
(** The entries at the top of a fleet. *)

val fleet_settings : string -> entry list
(** [fleet_settings "vehicle"] is the settings of that entry of a fleet. *)

val find : string -> entry list
(** [find x] is all that is called [x]. *)
