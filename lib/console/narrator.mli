(** Messages about a run: each line of its journal as it is, the lines of the log for people, and what the program
    waits for. The same for a run that goes on, one that is resumed, and one that is over. *)

open Dolphin_semantics
open Dolphin_trace
open Dolphin_display

type t

type tell = event:string -> string -> unit
(** Takes a message: its kind, and its data in one line. *)

val make : Dolphin_app.Program_file.t -> tell -> t
(** [make program tell] gives [tell] the messages of a run of [program] from its beginning. *)

val entry : t -> Entry.t -> unit
(** The next line of the journal: the message [journal]. *)

val transition : t -> stuck:bool -> time:float -> Transition.t -> unit
(** Its lines of the log: messages [log], {!Dolphin_display.Log.transition}. *)

val configuration : t -> Configuration.t
(** The configuration after the latest transition. *)

val replaced : t -> Dolphin_app.Program_file.t -> Dolphin_semantics.Configuration.t -> unit
(** The run goes on with this program, in this configuration. *)

val news : t -> time:float -> World.vehicle_state -> unit
(** The lines of the log about this report on a vehicle, if there are any. *)

val remark : t -> time:float -> string -> unit
(** An unusual event. *)

val remark_on : tell -> time:float -> string -> unit
(** The same for a run whose program is missing. *)

val question : t -> time:float -> string -> unit
(** [question n ~time prompt] is that the program asks [prompt]: a message [said]. *)

type place_of_question = {
  at : string option;  (** ["3:5"], ["lib.dol:3:5"] *)
  is_confirm : bool;  (** it takes yes or no *)
}

val place_of_question : t -> string -> place_of_question
(** [place_of_question n prompt] is where the program, or a task that it executes, asks [prompt] now, and whether by
    [confirm]. *)

val open_questions : t -> (Open_question.t * string option) list
(** The questions that are open now, each with its place. *)

val waiting : t -> time:float -> unit
(** The message [waiting], with the events that the program waits for, if they have changed. *)

val replayed : t -> Entry.t -> Replay.t -> unit
(** A line of a journal and its consequences: {!entry}, and lines of the log. *)
