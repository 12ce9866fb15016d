(** Programs, from their files. *)

open Dolphin_syntax

type t = {
  path : string;
  source : string;
  (** the text, followed by that of the files that it includes, and by digests of its maps *)
  parameters : Parameters.t list;  (** with the values that the text gives them *)
  set : (string * string) list;  (** those that were set, each with the text of its value *)
  ast : Ast.program;  (** with its included files and its parameters *)
  program : Dolphin_semantics.Core.program;
  warnings : Diagnostic.t list;
  without_place : Diagnostic.t list Lazy.t;
  (** {!Dolphin_semantics.Elaborate.plans_without_place}: wrong unless program or fleet have a place *)
  plans : place:Dolphin_geo.Position.t option -> (Ast.expression * Dolphin_plans.Inline_plan.t) list;
  (** {!Dolphin_semantics.Elaborate.known_plans} *)
}

val load :
  ?set:(string * string) list -> ?may_read:(string -> (unit, string) result) -> string -> (t, Error.t) result
(** [load ~set ~may_read path] is the program in the file [path], parsed and elaborated, with its included files
    ({!Dolphin_syntax.Include}) and its parameters [set] ({!Dolphin_syntax.Parameters.set}); none by default.
    [may_read] decides for each file that the text names whether it may be read, by default all. *)

val within : Fleet_file.t -> t -> (t, Error.t) result
(** [within fleet p] is [p] with the fences and warnings of [fleet], besides its own, and with the place of [fleet] for
    plans if [p] has none; or which of its plans break a fence or have no place, as far as that is known before it
    runs. *)

val load_recorded :
  set:(string * string) list -> recorded:(string * string) list option -> string -> (t, Error.t) result
(** [load_recorded ~set ~recorded path] is the program as a run had it that recorded what its parameters were set to,
    if there is one; to set others is an error. *)

val load_with_fleet :
  set:(string * string) list -> ?recorded:(string * string) list -> fleet:string option -> string ->
  (t * Fleet_file.t, Error.t) result
(** [load_with_fleet ~set ~recorded ~fleet path] is the program that {!load_recorded} loads, {!within} the fleet that
    {!Fleet_file.load_for} chooses, and that fleet. *)

val parse : string -> (Ast.program, Error.t) result
(** [parse path] is the syntax tree of the program in the file [path], which need not elaborate. *)

val header : t -> Dolphin_trace.Header.source
(** The program as journals name it: by its path, the digest of its text, and its parameters. *)

val location : t -> Dolphin_semantics.Core.site -> Dolphin_syntax.Location.t option
(** [location p s] is the place in the text of [p]; [None] if [s] has none. *)

val at : t -> Dolphin_semantics.Core.site -> string option
(** [at p site] is the place of [site], ["missions/survey.dol:3:10"], if it is known. *)

val line : t -> Dolphin_semantics.Core.site -> string
(** [line p site] is the same in short, ["survey.dol:3"]; [""] if it is not known. *)

val diagnostic : t -> Dolphin_semantics.Fault.t -> Diagnostic.t
(** [diagnostic p fault] is the fault of a run of [p], with its place in the text if it has one. *)

val unsettled : t -> Dolphin_semantics.Fault.t -> Error.t
(** [unsettled p fault] is {!Error.Unsettled}, with [diagnostic p fault]. *)
