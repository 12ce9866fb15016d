(** The vehicles of an adapter, a child process that speaks the platform protocol ([docs/platform.md]), as a platform:
    the shell around {!Dispatch}. It holds the process and the clock, and decides nothing but when an adapter that died
    is started again. *)

open Dolphin_semantics
open Dolphin_runtime
module Order := Dolphin_platform_protocol.Order

(** The options of an adapter. *)
type options = {
  command : string;  (** for [/bin/sh] *)
  purpose : Order.purpose;
  program : string option;  (** the name of its file *)
  run : string;  (** the identity of the run, or [""]: requests are named by it ({!Dispatch.create}) *)
  dolphin : string;  (** our version, for the adapter's logs *)
  taken : string list;  (** names that other platforms of the run have *)
  close_patience : float;  (** the seconds that [close] waits for stops to be confirmed *)
  note : Core.vehicle option -> string -> unit;  (** gets unusual events, for people *)
  keep : time:float -> Core.vehicle -> Yojson.Safe.t -> unit;
  (** keeps what a console that takes over has to know; when it returns, the note must survive this process *)
  sync : (unit -> unit Lwt.t) option;
  (** resolves once all that was kept before survives this machine, too; orders to start wait for that *)
  clock : Clock.t;
}

val default : command:string -> options
(** For a program without a name; nothing is kept, and nothing reported. *)

include Platform.S

val open_ : options -> (t, string) result Lwt.t
(** [open_ options] starts the adapter. The error is the reason why it cannot be spoken to. *)

val open_again : options -> time:float -> (string -> History.t) -> (t, string) result Lwt.t
(** [open_again options ~time history] takes over, at [time], from a console that died after [history name], where
    [name] is this platform's. *)

val leave : t -> unit Lwt.t
(** [leave p] closes [p] and stops nothing: vehicles go on, for a console that takes over. *)

val platform : t -> string
(** Its name: the adapter's name for itself, or that with a number. *)

val offers : t -> string list
(** The kinds of plans that the adapter takes. *)

val vehicles : t -> Dispatch.vehicle list
(** The known vehicles, by id. *)

val check : t -> ?vehicle:Core.vehicle -> Core.platform_task -> (string list, string) result Lwt.t
(** The obstacles to running the plan on the vehicle, from the adapter; the error is the reason why it does not
    answer. *)

val restart_delays : float list
(** Seconds after which an adapter that died is started again; the last one from then on. *)
