(** The questions of an editor about a program or a fleet. Pure: texts in, answers out; places are bytes of the text.

    {[
      open Dolphin_service

      let source = "radius = 2\nmessage radius"
      let text = Service.read ~file:"a.dol" source

      let () =
        assert (Service.diagnostics text = []);
        let use = String.length source - 3 in
        assert (List.map (fun (s : Service.span) -> s.start) (Service.references text use) = [ 0; 19 ]);
        match Service.definition text use with Some place -> assert (place.span.start = 0) | None -> assert false
    ]} *)

open Dolphin_syntax

(** As {!Occurrences.span}. *)
type span = Occurrences.span = { start : int; stop : int }

type fleet = { path : string; text : string }
(** A fleet file that a program runs with. *)

type t
(** A text under way, and its analysis. *)

val read : file:string -> ?fleet:fleet -> ?may_read:(string -> (unit, string) result) -> string -> t
(** [read ~file ~fleet ~may_read source] is the program [source], which would run with [fleet]; or the fleet
    [source], if [file] ends in [.fleet]. [file] is only a name. [may_read] decides for each file that the text
    names, to include or as a map, whether it may be read; by default all. *)

val source : t -> string
(** The text of {!read}. *)

val diagnostics : t -> Diagnostic.t list
(** The diagnostics of [dolphin check] for the text, in its order. *)

(** {1:writing Writing} *)

(** The kind of a name, for the symbols of editors. *)
type item_kind = Keyword | Function | Variable | Setting | Member | Constant | Text

type item = { label : string; kind : item_kind; form : string; text : string }
(** A name that may stand here, its spelling, and its meaning. *)

val complete : t -> int -> span * item list
(** [complete d offset] is the part of a name before [offset], and the names that may stand there. *)

val signature : t -> int -> item option
(** [signature d offset] is the function, procedure, maneuver or setting whose arguments are written at [offset]. *)

val format : t -> (string, Diagnostic.t list) result
(** {!Formatting.program}. *)

val rename : t -> int -> string -> (span list, string) result
(** [rename d offset x] is the places of [x] so that the variable or function at [offset] is called [x], or the
    reason why it cannot: the program would have another meaning. *)

(** {1:reading Reading} *)

val hover : t -> int -> (span * string) option
(** [hover d offset] is the name at [offset] and its meaning, in Markdown. *)

(** A place in [file], whose text is [source]. *)
type place = { file : string; source : string; span : span }

val definition : t -> int -> place option
(** [definition d offset] is the place where the name at [offset] gets its first value, or where the fleet describes
    the plan or vehicle of this name; it may be in a file that the program includes. *)

val references : t -> int -> span list
(** [references d offset] is the places of the variable or function at [offset], its definition first. *)

(** A function or a global variable, with the place of its name in its definition. *)
type symbol = { name : string; is_function : bool; at : span }

val symbols : t -> symbol list
(** The functions and global variables, in the order of the text. *)

val allocations : t -> (int * string list) list
(** The tasks of the program that vehicles of its fleet start in a run without faults: the beginning of each, in the
    order of the text, and its vehicles in the order of their starts. Empty for a program without a fleet, or with
    errors. *)

val shapes : t -> (Map_shapes.t list, Diagnostic.t list) result
(** {!Map_shapes.of_program}, empty for a fleet; or the faults of a text that cannot be parsed. *)

val beginning : t -> int
(** The byte at which the first statement begins; the end of a text without any, or with faults. *)
