(** Reproducible chance: numbers that depend only on their purpose. So the luck of one vehicle does not depend on how
    many draws others made before, and a run is the same with every version of the compiler (whose own generator
    changed with OCaml 5). *)

(** The purposes: the duration of a task, whether it fails, when, and where the vehicle goes. *)
type question = Length | Failure | Moment | Course

val share : seed:int -> vehicle:string -> start:int -> question -> float
(** [share ~seed ~vehicle ~start q] is a number in the interval \[0, 1), uniformly distributed over seeds, vehicles,
    [start] (the task's ordinal on that vehicle) and questions. *)

val between : float -> float -> float -> float
(** [between least most share] is [least +. share *. (most -. least)]. *)
