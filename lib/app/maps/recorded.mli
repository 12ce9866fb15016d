(** Runs and plans as recordings for Foxglove, in channels of JSON. *)

open Dolphin_maps

val of_run : started:float -> Dolphin_trace.Summary.t -> Mcap_file.message list
(** [of_run ~started run] has for each vehicle [v] of the run, which began at [started], in seconds since the
    beginning of 1970: its samples in [/v/location], a [foxglove.LocationFix] each; type, height, battery and task of
    each sample in [/v/state], a [dolphin.Vehicle]; and in [/v/plan] the way of each plan that it starts and that the
    program describes, a [foxglove.GeoJSON]. The events of vehicles and program are in [/log], a [foxglove.Log] each. *)

val of_plans : (string * Feature.t list) list -> Mcap_file.message list
(** [of_plans plans] has the features of each plan, by its name [p], in [/p], a [foxglove.GeoJSON], all at time 0. A
    second plan of that name is [/p (2)]. *)
