(** The values that a program leaves to its user: [parameter n = 3, 'how many vehicles']. *)

type t = { name : string; value : Ast.expression; description : string option }

val of_program : Ast.program -> t list
(** In the order of the text. *)

val is_value : Ast.expression -> bool
(** Whether a parameter may have this value: a number, also with a unit, a text, a truth value, [null], a place such as
    [Location.APDL] or [location(41.18, -8.7)], or a list or map of these. *)

val pp : Format.formatter -> t -> unit
(** As in [n = 3]. *)

val range : t -> string -> int list option
(** [range p text] is the whole numbers of the range that [text] spells, as [1..8], [8..1] or [0..<4], if [p] is a
    whole number: several values for it. Longer ones than {!longest_range} are not offered. *)

val longest_range : int
(** 1,000. *)

val set : (string * string) list -> Ast.program -> (Ast.program, string) result
(** [set [ (x, text) ] p] is [p] whose parameter [x] has the value that [text] spells, in the place of its own. It is
    of the same kind: a number for a number, a whole one for a whole one, anything for [null]; a text needs no
    quotes. The error lists the fault and the existing parameters. *)
