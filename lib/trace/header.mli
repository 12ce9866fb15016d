(** The beginning of a journal: its program, its fleet, its options and its time. *)

(** A file as it was when the run began. *)
type source = {
  path : string;
  hash : string;  (** the MD5 digest of its text, in hexadecimal *)
  set : (string * string) list;  (** of a program: parameters that were set, each with the text of its value *)
}

type t = {
  program : source;
  fleet : source option;  (** [None]: the built-in fleet *)
  platform : string;  (** ["sim"], ["imc"] *)
  order : Dolphin_semantics.World.order;  (** of vehicles *)
  seed : int;
  speed : float option;  (** of a simulation, times real time; [None]: as fast as it goes *)
  started : string;  (** by the clock of the console, in UTC: ["2026-03-01T12:00:00Z"] *)
  run : string option;
  (** of a run on vehicles of a network: its identity in the world, which copies of the journal share *)
  fences : Dolphin_plans.Fences.fence list;  (** that vehicles are kept to *)
  place : Dolphin_geo.Position.t option;  (** the place of plans without one; of the program or its fleet *)
  begins : Dolphin_semantics.Calendar.t option;  (** the date 0, with its offset from UTC, for [timeOfDay()] *)
}

val source : ?set:(string * string) list -> path:string -> string -> source
(** [source ~set ~path text] is the file [path] whose contents are [text]; nothing is [set] by default. *)

val source_codec : source Dolphin_json.Codec.t
(** Its path, its hash, and its parameters. *)

val place : (Dolphin_geo.Position.t, Dolphin_geo.Position.t) Dolphin_json.Codec.fields
(** Its [latitude], [longitude] and [height]. *)

val utc : string Dolphin_json.Codec.t
(** A time, as {!of_utc} reads it. *)

val codec : t Dolphin_json.Codec.t
(** First lines of journals. *)

val of_utc : string -> float option
(** [of_utc "2026-03-01T12:00:00Z"] is that time in seconds since the beginning of 1970; [None] for any other text. *)

val version : int
(** Of the format: 1. *)

val format_fields : unit -> ('o, unit) Dolphin_json.Codec.fields
(** The beginning of first lines: [format] and [version]. *)

val format_members : Dolphin_json.Field.members
(** The beginning of first lines. *)

val check_format : Yojson.Safe.t -> (unit, string) result
(** Refuses files that are not journals, and journals of other versions. *)

val to_json : t -> Yojson.Safe.t
(** The first line of a journal. *)

val of_json : Yojson.Safe.t -> (t, string) result
(** Refuses what {!check_format} refuses. *)
