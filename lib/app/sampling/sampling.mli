(** Many simulated runs of a program, and the counts over all of them. *)

(** The runs that are asked for: up to [runs], or [until] the share of those that complete is known. *)
type settings = {
  seed : int;  (** of the first run; the others have the numbers that follow *)
  runs : int option;  (** how many, at most *)
  until : float option;  (** until the share of runs that complete is known so well *)
  jobs : int;  (** processes *)
  answers : string list;
}

val level : float
(** 0.95: the probability with which intervals contain what they are estimates of. *)

(** The reason for the end of the runs. *)
type stop =
  | All  (** there are as many as were asked for *)
  | Known  (** the share of runs that complete is known as well as was asked for *)
  | Interrupted of int list  (** by the user; the seeds of runs that were under way *)

(** A way in which some runs ended. *)
type ending = {
  ending : Sampled_run.ending;
  runs : int;
  seed : int;  (** of the first run that ended so *)
}

(** A platform task that began in some run. *)
type task = {
  task : Sampled_run.task;
  counts : Sampled_run.counts;  (** of all runs together *)
  failing : int;  (** runs in which it failed *)
}

(** A handler of errors: how often it ran in all runs together, and in how many of them. *)
type handler = { site : Dolphin_semantics.Core.site; ran : int; runs : int  (** in which it ran *) }

type t = {
  settings : settings;
  runs : int;
  endings : ending list;  (** completed first, then by how many ended so *)
  completed : Dolphin_statistics.Distribution.t;  (** when runs that complete are over *)
  first : (float * int) option;  (** when the first one of these is over, with its seed *)
  last : (float * int) option;
  tasks : task list;  (** in the order in which they began first *)
  handlers : handler list;  (** by their places *)
  level : float;  (** of the intervals: {!level}, or that of the last look *)
  stop : stop;
  seconds : float;  (** it took *)
}

val share : t -> int -> Dolphin_statistics.Share.interval
(** [share s n] is the interval for the share of which [n] of the runs of [s] are a sample. *)

val run :
  interrupted:(unit -> bool) -> progress:(int -> unit) -> each:(seed:int -> Sampled_run.t -> unit) -> settings ->
  Program_file.t -> Fleet_file.t -> (t, Error.t) result
(** [run ~interrupted ~progress ~each s program fleet] is the runs with the seeds from [s.seed] on; which ones
    depends neither on [s.jobs] nor on chance, unless [interrupted ()] becomes true. [progress] gets their number,
    [each] each run, in the order of seeds, but not those after runs that an interruption left out. When it is over,
    no process is left. *)

val count :
  answers:string list -> (add:(seed:int -> Sampled_run.t -> unit) -> (unit, Error.t) result) -> (t, Error.t) result
(** [count ~answers read] counts in the same way the runs that [read ~add] gives to [add], in the order of their
    seeds, without gaps. They were made with [answers]. *)
