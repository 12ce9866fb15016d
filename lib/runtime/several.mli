(** Several platforms of real time as one: each vehicle is commanded by the platform that offers it.

    The first platform keeps the time and the timers. A vehicle that two platforms offer at once belongs to the one
    that offered it first; it is not ready as long as that is so, and people get a message. Platforms that have events
    at the same time take turns. *)

open Dolphin_semantics

include Platform.S

(** One of them. *)
type part = Part : (module Platform.S with type t = 'p) * 'p -> part

val make :
  note:(Core.vehicle -> string -> unit) -> keep:(time:float -> Core.vehicle -> Yojson.Safe.t -> unit) ->
  owners:(Core.vehicle * string) list -> (string * part) list -> t
(** [make ~note ~keep ~owners parts] is [parts], at least one, each with a name of its own. [note] gets vehicles that
    two platforms offer. [keep] keeps the platform of a bound vehicle; [owners] is the kept data of a run that is
    resumed. *)

(** {1:resumption Resumption} *)

val owners : imc:string -> History.t -> (Core.vehicle * string) list
(** [owners ~imc history] is the last platform of each vehicle of the program, by the notes; [imc] is the name of the
    one whose own notes do not name it. *)
