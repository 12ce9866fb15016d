(** Messages with the measurement of one quantity: Temperature, Salinity, Depth, Chlorophyll ... *)

val of_message : Message.t -> (string * float) option
(** [of_message m] is the name of [m], ["Temperature"], and its value in the unit of IMC, if [m] is such a message. *)

val to_message : string -> float -> Message.t option
(** [to_message name x] is the message of that name, if there is one. *)

val is_id : int -> bool
(** [is_id id] is whether such a message has the number [id]. *)

val names : string list
(** All their names. *)
