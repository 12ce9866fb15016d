(** The environment of translation, and the checks on the way: kinds of literals, operands, settings, and the places
    of procedures. *)

module Ast = Dolphin_syntax.Ast
module Location = Dolphin_syntax.Location
module Diagnostic = Dolphin_syntax.Diagnostic
open Core

type env = {
  program : Scope.program;  (** its tables *)
  code : Scope.code;  (** the piece that is being translated *)
  answer : bool;  (** whether that is an answer to [ask] *)
  of_expression : env -> Ast.expression -> expression;
  of_statements : env -> Location.t -> Ast.statement list -> expression;
}
(** The contents of a construct may be anything. So the modules of single constructs come before {!Translate}, and it
    gives itself to them here. *)

val elaborate : env -> Ast.expression -> expression
(** [elaborate env e] is [e] in the core. *)

val statements : env -> Location.t -> Ast.statement list -> expression
(** [statements env at body] is [body], which stands at [at], as one expression: its value is that of the last
    statement. *)

(** {1:make Core expressions} *)

val expression : env -> Location.t -> node -> expression
(** [expression env at node] is [node] with a site of its own. *)

val constant : env -> Location.t -> value -> expression
(** [constant env at x], like those below, makes an expression that stands at [at]. *)

val apply : env -> Location.t -> operation -> expression list -> expression
(** [apply env at o es] applies the operation [o] to the values of [es]. *)

val block : env -> Location.t -> expression list -> expression
(** One expression is itself. *)

val local : env -> Location.t -> int -> expression
(** [local env at slot] is the value of the local in [slot]. *)

val set_local : env -> Location.t -> int -> expression -> expression
(** [set_local env at slot e] puts the value of [e] into [slot], and has that value. *)

val null : env -> Location.t -> expression
(** [null env at] is the literal [null]. *)

val unless_null : env -> Location.t -> expression -> (expression -> expression) -> expression
(** [unless_null env at e f] is [null] if [e] is, otherwise [f x] of the local [x] that keeps the value of [e]. *)

(** {1:report Reports} *)

val error : env -> ?hint:string -> Diagnostic.code -> Location.t -> ('a, unit, string, unit) format4 -> 'a
(** [error env ~hint code at format ...] reports that text; translation goes on, to find other faults. *)

val did_you_mean : string -> string list -> string option
(** The hint that one of the names may be meant, if one is near. *)

val hint_for_setting : Ast.builder -> string -> string option
(** [hint_for_setting b name] is the replacement for [name], which is not a setting of [b]. *)

val sends_message : string
(** The name of a procedure of the original language that is left out. *)

val hint_for_message : string
(** Its replacement, as a hint. *)

(** {1:kinds Kinds} *)

val kind_of : Ast.expression -> Builtins.kind
(** [kind_of e] is the static kind of the value of [e], with the language's meaning of names. *)

val known_kind : env -> Ast.expression -> Builtins.kind
(** As {!kind_of}, but functions of the program hide names of the language. *)

val operand_kind : env -> Ast.expression -> Builtins.kind
(** As {!known_kind}, and variables that are assigned once have the kind of their value. *)

val check_operand : env -> string -> Builtins.kind -> Ast.expression -> unit
(** As {!check_kind}, by {!operand_kind}. *)

val could_be : Builtins.kind -> Builtins.kind -> bool
(** [could_be wanted found] is whether a value of kind [found] may be one of kind [wanted]. *)

val check_kind : env -> string -> Builtins.kind -> Ast.expression -> unit
(** [check_kind env what wanted e] reports [e] if it cannot be what [what] takes. *)

val check_operator : env -> Ast.binary -> Ast.expression -> Ast.expression -> unit
(** Reports operands of [>>] and [|] that are not tasks. *)

(** {1:names Names} *)

val keys_of : Ast.argument list -> string option list
(** The names of arguments, [None] for those without. *)

val value_of : Ast.argument -> Ast.expression
(** An argument without its name. *)

val dotted : Ast.expression -> string option
(** ["Speed.Units.RPM"] of the members that spell it. *)

val root : string -> string
(** [root "Speed.Units.RPM"] is ["Speed"]. *)

val is_hidden : env -> string -> bool
(** Whether the program gives the name a meaning of its own. *)

val regrouped : is_procedure:(string -> bool) -> Ast.expression -> Ast.expression option
(** [regrouped ~is_procedure e] is [f ((x) + y)] for an [e] such as [f (x) + y], if [is_procedure f]: a call that has no
    value cannot be an operand. It is [None] for an [e] that does not begin with such a call of one value. *)

val in_settings : env -> string -> int option
(** The slot of the block of settings around, if it has a setting of this name. *)

val check_subtraction : env -> Ast.expression -> bool
(** Whether this is not [lon -8.7] or [message -5], which subtract; reports these. *)

val check_no_setting : env -> Ast.expression -> Ast.expression -> unit
(** [check_no_setting env target e] reports [target = e] if [target] is a setting of the block around. *)

val check_value : env -> string -> string Ast.located -> Ast.expression -> unit
(** [check_value env f k e] warns of a pair [k: e] of [f], which is [consume] or [poll], if [e] is a condition without
    parentheses around it: [1 && x]. *)

val never_waits : env -> Dolphin_syntax.Ast.expression -> bool
(** [never_waits env t] is whether the task [t] surely is done without any wait: it is made of actions. *)

val check_parameters : Scope.program -> string Ast.located list -> unit
(** Reports a parameter that has the name of one before it. *)

val check_repeated : env -> Ast.builder -> Ast.statement list -> unit
(** Reports a second [type], for example, among the statements of a [pick], which would replace the first one. *)

val fence : string
(** The word that declares a fence. *)

val locate : string
(** ["locate"], which declares where plans are, outside of [imcPlan]. *)

val builder_name : Ast.builder -> string
(** As programs spell it. *)

val builder_of_setting : string -> string option
(** The name of the builder that has such a setting. *)

val check_in_script : env -> string -> Location.t -> unit
(** Reports what belongs to the script if it stands in code of a task or in an answer. *)

val check_in_maker : env -> string -> Location.t -> unit
(** Reports this deed, if the code around is in the place of a task. *)

val check_place : env -> Builtins.t -> string -> Location.t -> unit
(** Reports a procedure that may not stand here, and notes what the program uses. *)

val check_supplier : env -> Ast.expression -> string Ast.located -> unit
(** [check_supplier env e x] reports [e.x] in code of a task if [e] is surely the supplier, which answers the script
    only. *)

val sensor_members : string list
(** Properties and methods that read positions or batteries. *)
