(** The functions and constants that every program has, with their arguments: for checking before anything runs. *)

(** The static kind of a value. *)
type kind =
  | Any
  | Number
  | String
  | Truth
  | Closure
  | Task
  | Vehicles
  | Position
  | Other  (** none of the above, as lists are *)

val describe : kind -> string
(** ["a number"]; {!Other} and {!Any} are ["a value"]. *)

(** The functions whose arguments are pairs of N. *)
type pairs = Post | Consume | Poll | Count

(** The arguments of a function. *)
type arguments =
  | These of { required : kind list; optional : kind list; operation : Core.builtin }
  | Text_or of { required : kind list; optional : kind list; operation : Core.builtin }  (** or one text instead *)
  | Geometry of { required : kind list; named : (string * kind) list; needed : string list }
  (** named ones may be left out, but for those needed *)
  | Pairs of pairs  (** [post ready: 1]: pairs of N; see {!Pairs} *)
  | Execute
  | Set_connection_timeout
  | Confirm  (** a prompt, put to people until they answer yes or no *)
  | Input
  | On_interrupt  (** keys, in a declaration *)
  | Assert  (** code, and perhaps a text *)
  | Fresh  (** code of keys *)

(** The code in which a procedure may be called. *)
type place =
  | Anywhere
  | Script_only  (** may wait, or changes B: not in code inside of a task *)
  | Handler_only  (** in [onError], and in functions that it calls *)
  | In_handler  (** in the text of an [onError] *)

type t = { arguments : arguments; place : place; result : kind; reads_sensors : bool }

val find : string -> t option
(** The procedure of that name. *)

val is_of_script : string -> bool
(** Whether this is a procedure that only the script may call. *)

val is_deed : string -> bool
(** Whether this is a procedure with an effect in the code of tasks: [message], [post] ... *)

val is_geometry : string -> bool
(** Whether this is one of {!Geometry}'s functions, which variables that a program assigns hide. *)

val changes : string -> bool
(** Whether this is a procedure that code may not call that only computes, and code of tasks may. *)

val names : string list
(** Of all procedures. *)

val constant : string -> Core.value option
(** [constant "Location.APDL"]: constants by their full name. *)

val constants : string list
(** The full names of all constants. *)

val owners : string list
(** The first names of constants and of [Math]'s functions: [Location], [Speed], [Z], [Math]. *)

val takes_nothing : string -> bool
(** Whether it is a procedure that needs no argument: [ignore()]. *)

val is_reserved : string -> bool
(** Whether no variable may have this name: it is an owner, or a procedure that gives nothing. *)

val math : string -> bool
(** Whether [Math] has a function of this name. *)

val math_names : string list
(** The functions of [Math]. *)

val settings : Dolphin_syntax.Ast.builder -> string list
(** The settings that a block may have. *)

val builder_names : string list
(** The words that open a block of settings. *)

val example_of_builder : string -> string option
(** [example_of_builder "pick"] is ["pick { type 'UUV' }"]; [None] for other words. *)
