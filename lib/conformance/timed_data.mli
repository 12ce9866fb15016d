(** Dates in cases and in the step protocol, in milliseconds since the start: when runs end and tasks run, and which
    tasks and timers of one run were not over when they should have been. *)

type json = Yojson.Safe.t
(** JSON of any shape. *)

(** The earliest and the latest date of something. *)
type window = { earliest : int; latest : int option  (** [None]: without a latest date *) }

(** All tasks of one name on one vehicle. *)
type task = { name : string; vehicle : string; moments : (string * window) list  (** by name, sorted: ["starts"] *) }

(** The dates of all runs of a program. *)
type times = {
  ends : (string * window) list;  (** by how runs end, sorted *)
  tasks : task list;
  endless : bool;  (** whether some run never ends *)
  missed : int list;  (** the lines of the [within] that some run misses, sorted *)
}

(** The event that came early or late: the end of a vehicle's task, or the expiry of a timer. *)
type ended = Vehicle of string | Timer of int

(** Something that was over before it could be, or was not when it had to be. *)
type finding = { at : int; ended : ended; too : string  (** ["early"] or ["late"] *) }

(** {1:members As JSON has them}

    Members that are not there are as in programs where nothing of that kind happens. *)

val times : Dolphin_json.Field.members -> (times, string) result
(** Reads the members that {!of_times} writes. *)

val of_times : times -> Dolphin_json.Field.members
(** The members of a case, or of a reply, for these dates. *)

val findings : json -> (finding list, string) result
(** Reads the array that {!of_findings} writes. *)

val of_findings : finding list -> json
(** An array with an object for each. *)

val dated : json -> (int * json, string) result
(** An event of a run, with its date, from an object with the members [at] and [event]. *)

(** {1:comparison What differs} *)

val difference : times -> times -> string option
(** [difference expected seen] is the difference in [seen], in a sentence without a full stop. Of tasks, only those
    in [expected] are compared. *)

val show_findings : finding list -> string
(** ["a too late at 4000"]; or ["nothing"]. *)
