(** A console that runs {!Mission}, or resumes it, and dies at a given point: the library as [dolphin exec] uses it. *)

(** When it dies, by SIGKILL. Lines of the journal are counted from 0; lines with a vehicle's position do not count,
    since their number depends on timing. *)
type death =
  | Before of int  (** before it writes this line: everything in the lines before was done *)
  | Within of int  (** in the middle of the line *)
  | After of int  (** when the line is written, before its effects *)
  | Never

val start : port:int -> journal:string -> log:string -> death -> int
(** [start ~port ~journal ~log death] is the process of a console that resumes the run of [journal], or begins it if
    the file does not exist. It exits with 0 if the mission was completed. Its debug log, each datagram of it, goes to
    the end of [log]. *)

val program : Dolphin_semantics.Core.program
val hash : string
