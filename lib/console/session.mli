(** The state of a console that its requests share, and the clients that follow its events. *)

open Dolphin_app

(** As {!Console.settings}. *)
type settings = {
  folder : Folder.t;
  run : Run.settings;
  fleet : string option;
  dolphin : string;
  page : Page.t;
  tiles : string option;
  listen : Unix.inet_addr option;
  certificate : Certificate.t option;
  operators : Operators.operator list;
  proxy_header : string option;
  version : string;
  workers : Worker_pool.limits;
}

type t

val make : settings -> t
(** [make s] has no run and no client; {!served_at} gives it its port. *)

val settings : t -> settings
(** The settings of {!make}. *)

val access : t -> Access.t
(** The rights of clients, as the settings have them. *)

val served_at : t -> int -> unit
(** [served_at h port]: requests come to [port] from now on. *)

val changed : t -> unit
(** All clients that follow events get the new state. *)

(** {1 Runs and analyses} *)

val run : t -> Live_run.t option
(** The run that goes on, or the latest one. *)

val busy : t -> bool
(** Whether a run goes on. *)

val begin_run : t -> (id:string -> changed:(unit -> unit) -> Live_run.t) -> Live_run.t
(** [begin_run h start] has the run that [start] gives in place of the one before, which is over. *)

(** One analysis of each subject at a time. *)

val analysis : t -> Analysis.subject -> Analysis.t option
(** [analysis h subject] is the latest analysis of [subject], if there was one. *)

val analyses : t -> Analysis.t list
(** The latest analysis of each subject. *)

val set_analysis : t -> Analysis.subject -> Analysis.t -> unit
(** [set_analysis h subject a] has [a] in place of the one before, which is cancelled. *)

(** {1 Work in other processes} *)

val workspace : t -> Workspace.t
(** The data that workers get with each task. *)

val workers : t -> Access.role -> Worker_pool.t
(** Those for requests of clients with this role. *)

val replays : t -> Access.role -> Worker_pool.t
(** The same for replays, which last as long as their readers want. *)

val own_workers : t -> Worker_pool.t
(** Workers for tasks of the console itself. *)

val worker_pids : t -> int list
(** The processes of all workers. *)

val close : t -> unit Lwt.t
(** Ends all workers; resolves once no vehicle is listened to. *)

val listening_left : t -> (unit -> 'a) -> 'a Lwt.t
(** [listening_left h begin_] is [begin_ ()], once the platforms are closed on which vehicles are heard while no run
    goes on. They are opened again when the run is over that [begin_] has begun. *)

(** {1 The helm} *)

val operator : t -> string -> Live_run.operator option
(** [operator h client] is the operator whose client has this name, if operators have names. *)

val record_of : t -> string -> Operators.operator option
(** [record_of h client] is the same with role and duties. *)

val is_known : t -> string -> bool
(** [is_known h client] is false for clients of an operator who was shut out. *)

val addressee : t -> string -> string option
(** {!Operators.addressee}, of those of this console. *)

val may_answer : t -> string -> string -> bool
(** [may_answer h client prompt] is whether the question is for the operator of [client], or for everybody. *)

val is_admin : t -> string -> bool
(** Whether the client is one of an admin. *)

val operators : t -> Yojson.Safe.t
(** The operators with names, each with its role, duties, and the number of streams of events. *)

val shut_out : t -> string -> string -> (unit, string) result
(** [shut_out h client name]: the operator [name] has no access any more, until the console is started again; streams
    of events end, and the helm goes to the next. The error: [name] is the operator of [client], or unknown. *)

val name : t -> ?operator:string -> Access.role -> string -> string
(** {!Visitors.name}: clients are known by it here. *)

val helm : t -> Helm.t
(** The present holder of the helm, and the clients that ask for it. *)

val set_helm : t -> Helm.t -> unit
(** [set_helm h helm] puts [helm] in place of the present one; clients are informed. *)

val keep_helm : t -> string -> unit
(** [keep_helm h client]: [client] is alive. From then on it loses the helm if it does not repeat this within
    {!most_silent} seconds: a connection whose other end has vanished stays open for minutes. *)

val most_silent : float
(** 8 seconds. *)

val command : t -> string -> (unit, string) result
(** [command h client] is before a command of [client]: whoever looks on gets the helm by it if it is free, others may
    command as long as nobody has it. *)

val watches : t -> string -> bool
(** Whether this client looks on. *)

(** {1 Clients that follow events} *)

val status : t -> Yojson.Safe.t
(** All that stands beside the journal. *)

val follow : t -> Access.role -> client:string -> last:string option -> (string -> unit Lwt.t) -> unit Lwt.t
(** [follow h role ~client ~last write] writes server-sent events for [client] until [write] fails: the {!status}
    whenever it changes, and all messages of the run, from the one with the identity [last] on if that is of this run;
    at least one event each second. The client that asked first gets the helm soon after its holder has left. *)

val watchers : t -> Access.role -> int
(** The number of streams of events of clients with this role. *)

val streams_of : t -> string -> int
(** The number of streams of events of a client. *)
