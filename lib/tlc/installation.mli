(** The places of Java and TLC. *)

type t = { java : string; jar : string }
(** Absolute paths: of the program [java], and of the archive that TLC is in. *)

type trouble =
  | No_jar of { places : string list }  (** nowhere, of the usual places *)
  | No_such_jar of { path : string; said_by : string }  (** the given name is not a file *)
  | No_java of { said_by : string option }  (** neither on the path nor in [JAVA_HOME] *)

val variable : string
(** ["DOLPHIN_TLC"], of the environment: the place of the archive, by default. *)

val find : ?jar:string -> (string -> string option) -> (t, trouble) result
(** [find ~jar getenv] is Java, by [JAVA_HOME] or [PATH], and the archive: [jar], or the value of {!variable}, or the
    first that is in one of the usual places. These are Maven's repository (the highest of several versions),
    [/usr/share/java], and the usual places of TLA+'s Toolbox and of the archive of its releases. *)

val pp_trouble : Format.formatter -> trouble -> unit
(** The fault and its remedy; a sentence or two. *)
