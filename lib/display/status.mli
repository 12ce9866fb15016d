(** The present tasks of a program's vehicles, and the awaited events: the foot of a terminal. *)

open Dolphin_semantics

type t

val start : t
(** Nothing has happened. *)

val transition : t -> time:float -> Transition.t -> t
(** [transition b ~time t] is [b] after [t] at [time] (seconds). *)

val news : t -> World.vehicle_state -> t
(** [news b state] is [b] after the news of a vehicle. *)

val lines :
  t -> now:float -> estimate:(Core.vehicle -> string option) -> waiting:Waiting.t list -> rows:int -> columns:int ->
  colour:bool -> string list
(** [lines b ~now ~estimate ~waiting ~rows ~columns ~colour] is at most [rows] lines of at most [columns] characters,
    colours not counted: the time and the number of vehicles; the awaited events; then one line for each bound
    vehicle: its task, its progress ([estimate]), its running time, its battery or that it has no link, its position.
    Vehicles in trouble come first: without a link, with a failed task, with little left in their batteries; then in
    pick order. Empty while no vehicle is bound and nothing is waited for. *)
