(** The data of requests in journals, for a console that takes over. *)

open Dolphin_semantics
open Dolphin_runtime

type t =
  | Asked of { request : string; plan : string }  (** The order to start is about to leave. *)
  | Note of { request : string; note : Yojson.Safe.t }  (** of the adapter *)
  | Unsettled of { request : string; plan : Yojson.Safe.t }
  (** The task has failed, and it is not certain that the vehicle does not run it. *)
  | Over of string  (** It was to be stopped, and has ended. *)

val to_json : platform:string -> t -> Yojson.Safe.t
(** [to_json ~platform k] is the object in a [platform] line of the journal. *)

val latest : platform:string -> Yojson.Safe.t list -> (string * Yojson.Safe.t list) option
(** [latest ~platform notes] is the latest request that was asked and is not over by [notes], latest first, with the
    adapter's own notes on it, latest first. *)

val unsettled : platform:string -> History.t -> (Core.vehicle * string * Yojson.Safe.t) list
(** The vehicles that may still run something, with the request and its plan. *)
