(** What an editor asks about a program or a fleet. Pure: texts in, answers out; places are bytes of the text. *)

open Dolphin_syntax

type span = Occurrences.span = { start : int; stop : int }

type fleet = { path : string; text : string }
(** A fleet file that a program runs with. *)

type t
(** A text under way, and what is known of it. *)

val read : file:string -> ?fleet:fleet -> ?may_read:(string -> (unit, string) result) -> string -> t
(** [read ~file ~fleet ~may_read source] is the program [source], which would run with [fleet]; or the fleet [source],
    if [file] ends in [.fleet]. [file] is only a name. [may_read] says of each file that the text names, to include or
    as a map, whether it may be read; by default all. *)

val source : t -> string

val diagnostics : t -> Diagnostic.t list
(** What [dolphin check] says of the text, in its order. *)

(** {1:writing Writing} *)

type item_kind = Keyword | Function | Variable | Setting | Member | Constant | Text

type item = { label : string; kind : item_kind; form : string; text : string }
(** A name that may stand here, how it is written, and what it is. *)

val complete : t -> int -> span * item list
(** [complete d offset] is the part of a name before [offset], and the names that may stand there. *)

val signature : t -> int -> item option
(** [signature d offset] is the function, procedure, maneuver or setting whose arguments are written at [offset]. *)

val format : t -> (string, Diagnostic.t list) result
(** {!Formatting.program}. *)

val rename : t -> int -> string -> (span list, string) result
(** [rename d offset x] is where [x] is to stand so that the variable or function at [offset] is called [x], or why it
    cannot: the program would mean something else. *)

(** {1:reading Reading} *)

val hover : t -> int -> (span * string) option
(** [hover d offset] is the name at [offset] and what it is, in Markdown. *)

type place = { file : string; source : string; span : span }

val definition : t -> int -> place option
(** [definition d offset] is where what is named at [offset] gets its first value, or where the fleet describes the plan
    or vehicle of this name; it may be in a file that the program includes. *)

val references : t -> int -> span list
(** [references d offset] is where the variable or function at [offset] is named, its definition first. *)

type symbol = { name : string; is_function : bool; at : span }

val symbols : t -> symbol list
(** The functions and global variables, in the order of the text. *)

val allocations : t -> (int * string list) list
(** The tasks of the program that vehicles of its fleet start in a run in which all goes well: where each begins, in the
    order of the text, and its vehicles in the order of their starts. Empty for a program without a fleet, or with
    errors. *)
