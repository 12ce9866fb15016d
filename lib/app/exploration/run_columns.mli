(** A run of a program, as the commands that look for one show it. *)

open Dolphin_semantics

val print : ?decided:int -> Program_file.t -> steps:Transition.t list -> cycle:Transition.t list -> unit
(** In columns (see {!Dolphin_display.Columns}), as many as the terminal or [COLUMNS] has; the cycle, if any, follows
    it and repeats. The step numbered [decided] is marked as the one that decides a formula. Below stand the tuples that
    are left then. *)

val columns : unit -> int option
(** How many columns there are: of the terminal on standard output, or else of [COLUMNS]. *)

val say : string -> unit
(** [say text] prints [text] in lines of at most {!columns}, a single one if these are not known. *)

val text : ?decided:int -> Program_file.t -> steps:Transition.t list -> cycle:Transition.t list -> string
(** The text of {!print}, in as many columns as it takes. *)

val print_waiting : Program_file.t -> Transition.t list -> unit
(** The conditions that the program awaits after this run, if any, each once. *)
