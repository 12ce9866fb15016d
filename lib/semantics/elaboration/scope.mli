(** The names of a program while it is elaborated: globals, functions, and the locals of each piece of code. Mutable,
    and gone once the program is made. *)

module Ast = Dolphin_syntax.Ast
module Location = Dolphin_syntax.Location

(** {1:program One program} *)

type program
(** The tables of a program. Mutable. *)

val create :
  ?first_site:Core.site ->
  ?variables:Assigned.Names.t ->
  ?parameters:string list ->
  ?given:Assigned.Names.t ->
  ?suppliers:Assigned.Names.t ->
  ?kinds:(Builtins.kind * Assigned.Names.t) list ->
  ?chart:(string -> (Chart.t, string) result) ->
  functions:(string * Core.lambda) list ->
  globals:string list ->
  unit ->
  program
(** [functions] and [globals] exist already, as for an answer to [ask]; sites are numbered from [first_site] on, by
    default from 0. [variables] are names that the text gives a value to somewhere; [parameters], the program's
    parameters; [given], those that get a first value, by default all; [suppliers], the names of variables that surely
    are the supplier; [kinds], the variables of each kind, as far as they have one; [chart path] is the [map] of a
    file, by default that it cannot be read. *)

val site : program -> Location.t -> Core.site
(** A new site there. *)

val fresh_lambda_id : program -> int
(** A number that no other piece of code of the program has. *)

val report : program -> Dolphin_syntax.Diagnostic.t -> unit
(** Adds a diagnostic. *)

val reports : program -> Dolphin_syntax.Diagnostic.t list
(** All diagnostics, in the order of the text. *)

val locations : program -> Location.t array
(** The place of each site. *)

val location : program -> int -> Location.t option
(** The place of a site; [None] if the site is of another program, as in an answer. *)

val globals : program -> string array
(** The names of globals, by index. *)

val add_function : program -> string -> Core.lambda -> unit
(** Defines a function of the program. *)

val find_function : program -> string -> Core.lambda option
(** The function of that name. *)

val assigned_global : program -> string -> int
(** The index of a global that something assigns. *)

val used_global : program -> string -> Location.t -> int
(** The index of a global that is read there; {!unknown} reports whether anything assigns it. *)

val unknown : program -> (string * Location.t) list
(** Names that are read but that nothing assigns, with each place. *)

val note_ordered_key : program -> string -> unit
(** [consume k: _] takes the oldest pair of this key: its order must be kept. *)

val note_computed_order : program -> Location.t -> unit
(** The same for a key that is computed there. *)

val ordered_keys : program -> Tuple_space.order
(** The keys of {!note_ordered_key}. *)

val computed_orders : program -> Location.t list
(** The places of {!note_computed_order}. *)

val note_input : program -> of_vehicle:bool -> string Ast.located -> unit
(** [input 'k'] declares this key, and [input 'k', of: 'vehicle'] one whose values are single vehicles. *)

val is_input : program -> string -> bool
(** Whether an [input] that was noted has this key. *)

val inputs : program -> string Ast.located list
(** Those that were noted, in the order of the text. *)

val vehicle_inputs : program -> string list
(** Those of them whose values are single vehicles. *)

val note_interrupt : program -> Core.lambda -> unit
(** [onInterrupt] declares what an interruption executes. *)

val on_interrupt : program -> Core.lambda option
(** The notes. *)

val note_looked_at : program -> string option -> unit
(** Code consumes or polls pairs with this key; [None]: with a key that it computes. *)

val is_looked_at : program -> string -> bool
(** Whether code may consume or poll pairs with this key. *)

val note_sensor : program -> unit
(** Something looks at a sensor, or at a place. *)

val note_now : program -> unit
(** Something reads the date. *)

val note_time_of_day : program -> unit
(** Something reads the date as a time of day. *)

val note_running : program -> unit
(** Something asks whether a vehicle runs a task. *)

val note_recruit : program -> unit
(** Some task may recruit vehicles. *)

val recruits : program -> bool
(** Whether any may. *)

val note_rounds : program -> unit
(** Some task may begin rounds without a number: by [repeat], or by [retry()]. *)

val goes_round : program -> bool
(** Whether any may. *)

val reads_sensors : program -> bool
(** Whether {!note_sensor} was called. *)

val reads_now : program -> bool
(** Whether {!note_now} or {!note_time_of_day} was called. *)

val reads_time_of_day : program -> bool
(** Whether {!note_time_of_day} was called. *)

val asks_running : program -> bool
(** Whether {!note_running} was called. *)

val note_hint : program -> certain:bool -> Location.t -> (string -> string) -> unit
(** [note_hint program ~certain at hint]: if the name there is unknown, [hint name] is the correction; if it is not
    [certain], then only if no known name is like it. *)

val hint_at : program -> Location.t -> (bool * (string -> string)) option
(** The result of {!note_hint} for this place: whether it is certain, and the hint. *)

val is_assigned : program -> string -> bool
(** Whether something gives a value to a variable of this name. *)

val has_first_value : program -> string -> bool
(** Whether something gives this variable a value that does not depend on an earlier one. *)

val has_like : program -> string -> bool
(** Whether this may be a misspelt variable of the program. *)

val is_parameter : program -> string -> bool
(** Whether this is the name of a parameter that the program declares. *)

val chart : program -> string -> (Chart.t, string) result
(** The arguments of {!create}. *)

val note_chart : program -> string -> string -> Chart.t -> unit
(** [note_chart p x path chart]: the variable [x] surely is the map of the file [path], which is [chart]. *)

val find_chart : program -> string -> (string * Chart.t) option
(** The notes of {!note_chart} on a variable. *)

val kind_of_variable : program -> string -> Builtins.kind
(** The kind of the variable in [kinds], [Any] by default. *)

val is_supplier : program -> string -> bool
(** Whether the variable is one of the [suppliers]. *)

(** {1:code One piece of code} *)

(** The purpose of a piece of code, which decides its permitted effects. *)
type purpose =
  | Main
  | Named_function of string
  | Plain  (** a closure of the script *)
  | Task_code of string  (** of this construct: ["action"] *)
  | Maker  (** code in the place of a task, which makes it *)
  | Handler

type code
(** A piece of code, with its locals and what is around it. Mutable. *)

val code : program -> purpose -> code option -> code
(** [code p purpose outer] is a new piece inside of [outer]. *)

val purpose : code -> purpose
(** Its purpose. *)

val in_task : code -> string option
(** The task construct that the piece is in, directly or not. *)

val may_give_task : code -> bool
(** [may_give_task c] is whether [c] is code in the place of a task, of a handler, or a closure in one of these: its
    value may be a task. *)

val new_slot : code -> int
(** A slot for a value that has no name. *)

val slots : code -> int
(** How many slots it needs. *)

val define : code -> string -> int
(** A new local of this name, visible until the end of the block. *)

val in_block : code -> (unit -> 'a) -> 'a
(** Names defined inside are forgotten after. *)

val at_top : code -> bool
(** Whether a [def] here makes a global: in the script, outside of any block. *)

(** A local by its slot: [Own] of the piece, or [Captured] by it. *)
type local = Own of int | Captured of int

val find_local : code -> string -> local option
(** A local of this piece, or of a piece around it, which is then captured; by its slot in this piece. *)

val field : string -> string -> string
(** [field e f] is the local that has the field [f] of the error [e]: no name of a program. *)

val has_fields : code -> string -> bool
(** Whether the name is that of the error that a handler around gets. *)

val in_handler : code -> bool
(** Whether the piece is in the text of an [onError]. *)

val captures : code -> (int * int) list
(** For each captured value, its slot in the piece around and its slot here. *)

(** {1:loops Loops and settings} *)

val in_function : code -> bool
(** Whether it is that of a function of the program, or of a closure in one. *)

val in_loop : code -> bool
(** Whether [break] and [continue] have a loop to leave. *)

val inside_loop : code -> (unit -> 'a) -> 'a
(** [inside_loop c f] is [f ()], in the body of a loop. *)

val settings : code -> (Ast.builder * int) option
(** The block of settings around, and the slot where they gather. *)

val within_branches : code -> bool
(** Whether it is code within [allOf { ... }] or [oneOf { ... }]. *)

val inside_settings : code -> (Ast.builder * int) option -> (unit -> 'a) -> 'a
(** Inside of a block of settings, kept in that slot, names of settings have their meaning; loops around it cannot be
    left from inside. *)

val visible_names : code -> string list
(** All names that could have been meant here. *)

(** {1:calls Calls} *)

val note_blocking : code -> string -> unit
(** This piece uses something that belongs to the script. *)

val note_call : code -> string -> Location.t -> unit
(** This piece calls a function of the program. *)

val blocking_calls_in_tasks : program -> (string * string * string * Location.t) list
(** For each call in code of a task that reaches an operation of the script: the task construct, the function called,
    the operation, its place. *)
