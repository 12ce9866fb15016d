(** The corpus of conformance: its cases, and implementations judged by them. *)

open Dolphin_conformance

val load : string list -> (Case.t list, Error.t) result
(** [load paths] is the cases in these files, and all cases in these directories. Schemas are
    not cases. *)

val with_implementation : name:string -> timeout:float -> string option -> (Dialogue.ask -> 'a) -> 'a
(** [with_implementation ~name ~timeout command f] is [f ask], where [ask] queries the program of the shell command
    [command], which has [timeout] seconds for each reply, or without it this implementation, by the name [name].
    Signals that ask to stop then raise [Sys.Break]. *)

(** A case with its verdict; [passed] is {!Judge.passes}. *)
type judged = { case : Case.t; verdict : Judge.verdict; passed : bool }

val judge : Dialogue.ask -> (judged -> unit) -> Case.t list -> judged list * Matrix.t
(** [judge ask tell cases] judges each of [cases], and reports it at once by [tell]. *)
