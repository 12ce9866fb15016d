(** When something that was begun happens, counted from its beginning, in whole milliseconds. *)

type t =
  | Within of { least : int; most : int }  (** [0 <= least <= most]; both ends included *)
  | Some_time  (** unknown, if at all: at any moment from the beginning on *)
  | Never

val at_once : t
(** [Within { least = 0; most = 0 }]. *)

val milliseconds : float -> int option
(** [milliseconds seconds] is the nearest whole number of milliseconds; [None] if that is more than any run takes, as
    for [infinity]. *)

val exactly : float -> t
(** [exactly seconds] is {!Never} if there are too many of them. *)

val between : float -> float -> t
(** [between least most], in seconds, is [least] rounded down and [most] rounded up. *)

val from_the_start : t -> t
(** [from_the_start b] is when something may happen that may come any time until [b] is over. *)

val compare : t -> t -> int
(** A total order of bounds as data, in which it has no meaning which one is less. *)

val pp_time : Format.formatter -> int -> unit
(** [pp_time ppf ms] is the time of a stop-watch: ["9:00"], ["1:02:03"], ["0:07.5"]. *)
