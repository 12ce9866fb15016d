(** What a journal tells, gathered for pictures: who ran what from when to when, what the program did, where vehicles
    were. *)

type ending =
  | Done
  | Failed of string  (** why *)
  | Stopped
  | Unfinished  (** the journal ends before *)

(** A platform task that a vehicle ran. *)
type task = { plan : string; from : float; until : float; ending : ending }

type sample = { time : float; position : Dolphin_geo.Position.t; battery : float }
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

(** What the program did. *)
type deed =
  | Posted of string
  | Consumed of string
  | Said of string
  | Asked of string
  | Erred of string  (** a task of it failed *)

type t = {
  header : Header.t option;
  duration : float;  (** until the last line *)
  vehicles : vehicle list;  (** those that the program held, in the order in which it picked them *)
  deeds : (float * deed) list;
  ending : Request.ending option;  (** [None]: the journal breaks off *)
}

(** {1:making Making} *)

type teller

val start : unit -> teller
(** Nothing is told so far. *)

val tell : teller -> Entry.t -> unit
(** One line more, in order. *)

val finish : teller -> t
(** All that was told. *)
