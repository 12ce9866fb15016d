(** Recordings in the MCAP format, as Foxglove and the tools of ROS read them: messages with their times, in channels.
    Chunks of some 1 MB are indexed, and not compressed. *)

(** The format of a channel's messages. *)
type schema = {
  name : string;  (** ["foxglove.LocationFix"] *)
  json_schema : Yojson.Safe.t;
}

(** The messages of one topic, which have one schema. *)
type channel = { topic : string; schema : schema }

(** A message of a channel. *)
type message = { channel : channel; time : float;  (** seconds since the beginning of 1970 *) content : Yojson.Safe.t }

val last_year : int
(** The last year of which times can be written. *)

val nanoseconds : float -> int * int
(** [nanoseconds time] is the whole seconds of [time], at least 0, and the rest in nanoseconds. *)

val to_string : message list -> string
(** [to_string messages] is a file with [messages], in order of time, those of one time in the order given; with their
    channels, each once, and these channels' schemas. Contents are JSON. *)
