(** A console that runs {!Mission}, or resumes it, and dies when it is told to: the library as [dolphin exec] uses
    it. *)

(** When it dies, by SIGKILL. Lines of the journal are counted from 0; those that say where a vehicle is do not count,
    for how many there are depends on the moment. *)
type death =
  | Before of int  (** as it is about to write this line: all that the lines before tell of was done *)
  | Within of int  (** in the middle of the line *)
  | After of int  (** when the line is written, before anything that it tells of is done *)
  | Never

val start : port:int -> journal:string -> log:string -> death -> int
(** [start ~port ~journal ~log death] is the process of a console that resumes the run of [journal], or begins it if
    there is no such file. It exits with 0 if the mission was completed. Its debug log, each datagram of it, goes to the
    end of [log]. *)

val program : Dolphin_semantics.Core.program
val hash : string
