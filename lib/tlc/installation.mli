(** Where Java and TLC are. *)

type t = { java : string; jar : string }
(** Absolute paths: of the program [java], and of the archive that TLC is in. *)

type trouble =
  | No_jar of { places : string list }  (** nowhere, of the usual places *)
  | No_such_jar of { path : string; said_by : string }  (** what was said is no file *)
  | No_java of { said_by : string option }  (** not on the path, or not where [JAVA_HOME] says *)

val variable : string
(** ["DOLPHIN_TLC"], of the environment: where the archive is, if nothing else says so. *)

val find : ?jar:string -> (string -> string option) -> (t, trouble) result
(** [find ~jar getenv] is Java, by [JAVA_HOME] or [PATH], and the archive: [jar], or what {!variable} says, or the first
    that is in one of the usual places. These are Maven's repository (the highest of several versions),
    [/usr/share/java], and where TLA+'s Toolbox and the archive of its releases are commonly put. *)

val pp_trouble : Format.formatter -> trouble -> unit
(** What is wrong, and what would be right; a sentence or two. *)
