(** What requests about the folder of a console work on. Its functions read files and parse programs: but for the start
    of a run, they are called in the processes of {!Worker} only. *)

open Dolphin_app
open Exchange

type t = {
  folder : Folder.t;
  fleet : string option;  (** that of the command line, a path *)
  own : string option;  (** the journal of the run that goes on *)
}

val file : t -> string -> (string, refusal) result
(** [file w path] is the real path of a file of the folder. *)

val text : string -> (string, refusal) result
(** [text path] is the contents of the file [path]. *)

val of_error : file:string -> source:string -> Error.t -> refusal
(** [of_error ~file ~source e] is ["faults"], with the diagnostics of [e], which concern the text [source] of [file]. *)

val program : t -> ?set:(string * string) list -> string -> (Program_file.t, refusal) result
(** [program w ~set path] is the program in a file of the folder; the refusal has its diagnostics. *)

val fleet : t -> program:string -> string option -> (Fleet_file.t, refusal) result
(** [fleet w ~program named] is the fleet in the file [named] of the folder, or that of the console, or the one beside
    [program]. *)

val fleet_path : t -> program:string -> string option -> string option
(** [fleet_path w ~program named] is the file of the fleet that {!fleet} gives, if there is one. *)

val within : Fleet_file.t -> Program_file.t -> (Program_file.t, refusal) result
(** {!Program_file.within}. *)

val program_in_fleet :
  t -> set:(string * string) list -> fleet:string option -> string -> (Program_file.t * Fleet_file.t, refusal) result
(** [program_in_fleet w ~set ~fleet path] is {!program}, its {!fleet}, and the former {!within} the latter. *)
