(** Runs of programs, on the simulated fleet or on the vehicles of a network: to start one, to follow it, to stop it, to
    resume it after its console died.

    Code that shows runs to people is a {!front}: the terminal ({!Terminal_run}), or a server that sends the lines of
    the journal ({!Recording.settings}) to a browser. A front decides nothing about the run; it answers the program's
    remaining questions, and may stop the run by its {!Interruption}. Several runs may go on side by side. *)

open Dolphin_runtime
open Dolphin_trace

(** The options of a run. *)
type settings = {
  network : Dolphin_platform_imc.Udp_platform.options option;  (** vehicles that speak IMC *)
  adapters : string list;  (** commands that speak for further vehicles; without them and [network], the fleet is
                               simulated *)
  speed : float option;  (** of the simulation, times real time; [None]: as fast as it goes *)
  seed : int option;  (** of the simulation; [None]: 0, or that of the run that is resumed *)
  answers : string list;  (** to the first questions of the program *)
  people : bool;  (** whether all other questions are for people, although the fleet has answers *)
  supplier : string option;  (** a command; [None]: the fleet replies to calls *)
  supplier_timeout : float option;  (** seconds for each reply; [None]: any time *)
  socket : bool;  (** whether the run has a socket beside its journal, if its time passes by itself: {!Run_socket} *)
  recording : Recording.settings;
}

val choice : settings -> Networks.choice
(** The platforms that the settings ask for. *)

val is_simulated : settings -> bool
(** Whether neither [network] nor [adapters] has vehicles. *)

val simulated : settings
(** On the simulated fleet, as fast as it goes, with seed 0, without answers and supplier; nothing is kept. *)

(** {1:fronts Fronts} *)

(** How far a vehicle is with its plan, by its own estimate. *)
type estimate = Networks.estimate = {
  vehicle : string;
  plan : string;
  share : float;  (** from 0 to 1 *)
  remaining : float option;  (** seconds *)
}

type view = {
  now : unit -> float;  (** the time of the run, in seconds since its start *)
  estimates : unit -> estimate list;  (** of the vehicles that give one *)
  post : string -> Dolphin_semantics.Core.value -> bool Lwt.t;  (** {!Inputs.post} *)
  questions : unit -> string list;  (** {!Inputs.questions} *)
  replace : ?set:(string * string) list -> ?hash:string -> string -> (float, Replacement.refusal) result Lwt.t;
  (** {!Replacement.replace} *)
  acted : Act.t -> (unit, string) result;  (** keeps an operator's act in the journal: {!Recording.act} *)
}

(** The side of a run that is turned to people: a terminal or a page. {!unattended} has neither. *)
type front = {
  replayed : Entry.t -> Replay.t -> unit;
  (** gets each line of the journal of a run that is resumed, with its result, before all else *)
  notice : string -> unit;  (** shows a sentence, before the run begins or after its end *)
  opened : view -> unit;  (** The run begins; the view is valid from now on. *)
  remark : string -> unit;  (** shows what is unusual about a vehicle *)
  replaced : Program_file.t -> Replay.t -> unit;
  (** The run goes on with this program from now on; the journal so far, as read with it. *)
  observer : Observer.t;  (** gets each transition, and the known state of vehicles *)
  person : Questions.person;
  wants_telemetry : bool;  (** whether positions and batteries are wanted even if the program does not look at them *)
}

val unattended : front
(** Shows nothing and answers nothing. *)

(** {1:runs Runs} *)

val start :
  front -> interruption:Interruption.t -> settings -> Program_file.t -> Fleet_file.t ->
  (Driver.outcome, Error.t) result Lwt.t
(** [start front ~interruption s program fleet] runs [program] to its end, or until [interruption] happens, and resolves
    when vehicles are released and the recording is finished. On a network only the answers and replies of [fleet]
    matter. The error is {!Error.Unavailable}: of the platform, the supplier or the recording; or
    {!Error.Interrupted}, before the run began. The promise fails only
    for a fault of Dolphin itself. From then on SIGPIPE is ignored. *)

val resume :
  front -> interruption:Interruption.t -> settings -> changed:bool -> fleet:string option -> Program_file.t -> string ->
  (Driver.outcome, Error.t) result Lwt.t
(** [resume front ~interruption s ~changed ~fleet program path] continues, as {!start} does, the run whose journal is
    the file [path], in that file unless [s.recording] names another one. With [changed] the program need not be the one
    that ran, if the journal is one of a run of it. [fleet] names the fleet if it is elsewhere now; on a network, one
    whose answers and replies are used. The error is {!Error.Bad_input} if the run cannot be resumed, or not with these
    settings. *)

(** {1:outcomes Outcomes} *)

val explain : Program_file.t -> Driver.outcome -> Error.t option
(** [explain program outcome] is the fault in a run with this outcome, other than a [halt] or an interruption:
    {!Error.Bad_text} with the place of the fault, or of the conditions that cannot come true any more. *)
