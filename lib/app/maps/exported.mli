(** The traces of a run or a plan on a map, for other programs. *)

type t = {
  title : string;
  until : float;  (** the date of the last time in it, in seconds since the beginning of 1970 *)
  features : Dolphin_maps.Feature.t list;
  columns : string list;  (** of the table *)
  rows : Dolphin_maps.Feature.property list list;
  messages : Dolphin_maps.Mcap_file.message list Lazy.t;  (** as {!Recorded} has them *)
}

val of_run : Dolphin_trace.Summary.t -> t
(** [of_run run] has the track of each vehicle that the program held, and the starting places of its tasks. The rows
    are the samples, in order of time. *)

val of_plans : title:string -> Inline_plans.found list -> t
(** [of_plans ~title plans] has the way of each plan that the program describes, and the end of each of its
    maneuvers. The rows are the way points. Plans that vehicles know by name are left out. *)

val write : Dolphin_maps.Map_format.t -> string option -> t -> (unit, Error.t) result
(** [write format path map] writes into the file [path], to standard output without one. Nothing to write is an
    {!Error.Bad_input}, and so is a run that ends later than the format has dates. *)
