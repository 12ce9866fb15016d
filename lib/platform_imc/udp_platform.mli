(** Vehicles that speak IMC over UDP, as a platform: the shell around {!Station}. It holds the sockets and the clock,
    and decides nothing.

    Nothing is polled: a datagram, a command or a time that has come makes it act. Of datagrams that are there already
    many are taken at once; while they come by the thousand in a second, it lets them gather for {!gathering} first. *)

open Dolphin_semantics
open Dolphin_runtime

type options = {
  id : int option;  (** The IMC address; [None]: one by chance, from 0x4000 to 0x5FFF. *)
  name : string option;  (** [None]: ["ccu-dolphin-"] and the IMC address. *)
  program : string;  (** The name that other consoles see; [""]: they see none. *)
  loopback : bool;  (** Only this machine: neither multicast nor broadcast, and only 127.0.0.1 is bound. *)
  interfaces : Unix.inet_addr list;  (** Addresses of this machine to use; [[]]: all of them. *)
  data_port : int;  (** The port to which vehicles send; 0: any free one. *)
  announce_ports : int list;  (** The ports for announcements: the first free one is taken. *)
  group : Unix.inet_addr;  (** Of the announcements. *)
  payload : (Core.vehicle * string list) list;  (** Devices of vehicles, in place of their entity lists. *)
  types : (Core.vehicle * string) list;  (** Types of vehicles, in place of the announced ones. *)
  type_names : (int * string) list;  (** Of types for which IMC 5.4 has no names. *)
  records : bool;  (** Whether {!received} is kept. *)
  abort : bool;  (** Whether a vehicle that still maneuvers 3 s after the order to stop is ordered to abort. *)
  run : string;  (** The identity of the run, which copies of its journal share; [""]: none. *)
  close_patience : float;  (** The seconds that [close] waits for stops to be confirmed; for vehicles that are not
                               heard again yet, {!announce_period} at least. *)
  note : Core.vehicle -> string -> unit;  (** Gets unusual events, for people. *)
  keep : time:float -> Core.vehicle -> Yojson.Safe.t -> unit;
  (** Keeps what a console that takes over has to know ({!Durable_note}). When it returns, the note must survive this
      process. *)
  sync : (unit -> unit Lwt.t) option;
  (** Resolves once all that was kept before survives this machine, too. Requests to start plans wait for that; with
      [None] they do not. *)
  clock : Clock.t;  (** Only the dates in the headers of IMC packets begin with its [date]. *)
}

val default : options
(** As vehicles with the usual settings expect it: ports 30100 to 30104, the group 224.0.75.69, all interfaces, 5 s;
    notes are thrown away, and requests do not wait for them; {!received} is not kept; the clock is {!Clock.system}. *)

include Platform.S

exception Superseded of string
(** From [next]: another console has the run ({!Station.twin}), in words. *)

val open_ : options -> (t, string) result
(** [open_ options] listens and announces itself from now on. The error names the port that is not available. *)

val open_again : options -> time:float -> History.t -> (t, string) result Lwt.t
(** [open_again options ~time history] takes over, at [time], from a console that died after [history]; see
    {!Station.resume}. It listens for a moment first; the error may be that the run lives in another console. *)

val leave : t -> unit Lwt.t
(** [leave p] closes [p] and stops nothing: vehicles go on, for a console that takes over. *)

val now : t -> float
(** Seconds since the beginning, by a clock that is never set back. *)

val gathering : float
(** 2 ms. *)

(** {1:displays For displays} *)

val id : t -> int
(** The console's IMC address. *)

val name_on_network : t -> string
(** As other systems see it. *)

val data_port : t -> int
(** The port of its data socket. *)

val systems : t -> Station.system list
(** All systems that have announced, by name. *)

val received : t -> int -> (int * Received.entry) list
(** The messages of the system with this IMC address, by the number of the message, if the options keep them. *)

val progress : t -> Core.vehicle -> Execution.progress option
(** The plan that the vehicle runs for the program. *)

(** Datagrams since [open_]. *)
type traffic = {
  accepted : int;
  skipped : int;  (** of no interest *)
  dropped : (string * int) list;  (** by reason *)
  unsent : int;  (** the system refused to send them *)
}

val traffic : t -> traffic
(** The traffic since it was opened. *)
