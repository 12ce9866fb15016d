(** A run as pictures show it: the tasks of each vehicle with their times, the steps of the program, the places of
    vehicles. A summary is made from the lines of a journal. *)

(** The unit of times: seconds since the start, or numbers of steps, for a run without times. *)
type clock = Seconds | Steps

(** The end of a vehicle's task. *)
type ending =
  | Done
  | Failed of string  (** why *)
  | Stopped
  | Unfinished  (** the journal ends before *)

(** A platform task that a vehicle ran. *)
type task = {
  plan : string;
  from : float;
  until : float;
  ending : ending;
  way : Entry.way option;  (** [None]: not in the journal *)
}

(** A report of a vehicle on its place, with its battery then, from 0 to 1. *)
type sample = { time : float; position : Dolphin_geo.Position.t; battery : float option }

(** The seconds, or steps, from [from] to [until]. *)
type span = { from : float; until : float }

(** All lists are in order of time. *)
type vehicle = {
  id : string;
  kind : string;
  tasks : task list;
  held : span list;  (** when the program held it *)
  silent : span list;  (** when it had no link *)
  samples : sample list;
}

(** The steps of the program that a picture shows. *)
type activity =
  | Posted of string
  | Consumed of string
  | Said of string
  | Asked of string
  | Erred of string  (** a task failed; why *)

type t = {
  clock : clock;
  header : Header.t option;
  duration : float;  (** until the last line *)
  vehicles : vehicle list;  (** those that the program held, in the order in which it picked them *)
  activities : (float * activity) list;
  ending : Request.ending option;  (** [None]: the journal breaks off *)
  layers : Layer.t list;  (** below the ways of the picture; a journal has none *)
}

(** {1:making Making} *)

type builder
(** A summary in the making. It is mutable. *)

val create : ?clock:clock -> ?most_samples:int -> unit -> builder
(** [create ()] has no lines yet; their times are [Seconds] unless [clock] is another. Memory is bounded: of each
    vehicle [most_samples], by default a few thousand, are kept, evenly spread. *)

val add : builder -> Entry.t -> unit
(** [add b line] adds the next line of the journal. *)

val finish : builder -> t
(** [finish b] is the summary of the lines added so far. *)

(** {1:asking Asking} *)

val moment : t -> float -> string
(** A time as people read it: ["1:05"], ["step 12"]. *)

val runs : vehicle -> sample list list
(** Its samples, cut where the vehicle had no link in between. *)

val working : vehicle -> (sample * task option) list
(** Its samples, each with the task that it ran then. *)

val is_invented : t -> task -> bool
(** Whether the vehicle's way is the simulator's invention: it does not know the plan, only its name. *)

val places : vehicle -> (task * Dolphin_geo.Position.t) list
(** [places v] is the place of [v] at the start of each of its tasks. *)
