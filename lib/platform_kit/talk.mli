(** A conversation with an adapter, line by line, by one who may do what Dolphin never does. *)

open Dolphin_platform_protocol
module Order := Dolphin_platform_protocol.Order

exception Wrong of string
(** The fault of the adapter, in a sentence without a full stop. *)

type t

val start : string -> t
(** [start command] starts the adapter, without a greeting. *)

val send : t -> Order.t -> unit
(** [send t order] writes [order] to the adapter. *)

val send_text : t -> string -> unit
(** A line as it is, without its end. *)

val pause_reading : t -> bool -> unit
(** While it is on, the adapter's output is not read. *)

val await : t -> within:float -> what:string -> (Report.t -> 'a option) -> 'a Lwt.t
(** [await t ~within ~what fits] is the result of [fits] for the first report that it accepts, of those that no
    [await] has accepted; it may have come already. Raises {!Wrong} if none comes within [within] seconds, or the
    adapter ends. *)

val reports : t -> Report.t list
(** All that came so far, in order. *)

val first_line : t -> within:float -> (Report.t, string) result Lwt.t
(** The first line that came, or what is wrong with it. *)

val ends_within : t -> float -> bool Lwt.t
(** Whether the process ends within this number of seconds. *)

val close_input : t -> unit Lwt.t
(** As when Dolphin dies: the adapter's input ends. *)

val kill : t -> unit Lwt.t
(** Kills the adapter, and all that it has started. *)

val finish : t -> unit Lwt.t
(** Ends the adapter in good order. *)

val faults : t -> string list
(** The faults of its lines. *)

val transcript : t -> string list
(** The last lines of the conversation, with [<] those that we wrote and with [>] the adapter's. *)
