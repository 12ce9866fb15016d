(** One start of a plan on one vehicle, from the order to its end. Times are seconds of our clock. *)

open Dolphin_semantics
open Dolphin_platform_protocol

type stage =
  | Unwritten  (** The note on it is not yet on the disk. *)
  | Unsent  (** It is; no adapter was there to be ordered. *)
  | Ordered  (** An adapter was ordered to start or to resume it, and has not answered. *)
  | Taken  (** The vehicle has it. *)

type t = {
  request : string;
  plan : string;
  body : Yojson.Safe.t;  (** the plan, as the protocol has it *)
  stage : stage;
  wanted : bool;  (** the program waits for its end *)
  is_resumed : bool;  (** the last order was to resume it *)
  is_on_disk : bool;  (** The note on it is known to be on the disk. *)
  doubt : Order.doubt option;  (** what the journal that a console resumed may have lost *)
  begun : float;
  asked : float;  (** when the last order was sent that an answer is owed to *)
  stop_sent : float option;
  notes : Yojson.Safe.t list;  (** of the adapter, latest first *)
  share : float option;
  remaining : float option;
}

val make : now:float -> request:string -> Core.platform_task -> t
(** [Unwritten], and wanted. *)

val outstanding :
  ?is_on_disk:bool -> ?doubt:Order.doubt -> now:float -> request:string -> plan:string -> body:Yojson.Safe.t ->
  wanted:bool -> notes:Yojson.Safe.t list -> unit -> t
(** One that an adapter before this one was ordered to start; with [~is_on_disk:false] (by default true), may have been
    ordered to start: the journal has no note on it. *)

val is_sent : t -> bool
(** Whether an adapter may know of it. *)

val stop_patience : float
(** 60 s *)

val due : link:float option -> lost:float -> timeout:float -> patience:float -> t -> float
(** [due ~link ~lost ~timeout ~patience e] is when [e] is given up or its stop is; [infinity] if never. [link] is since
    when the vehicle has a link, if it has one; otherwise it has none since [lost]. *)
