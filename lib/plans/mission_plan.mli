(** Missions of items: the content of [mission { ... }], for vehicles whose plans are such missions, as those that
    speak MAVLink. Lengths are in metres, times in seconds, speeds in metres per second, angles in degrees, heights
    in metres above the home position. *)

module Position = Dolphin_geo.Position

(** The value of an argument. [Places] is a list of them, in order. *)
type argument =
  | Number of float
  | Truth of bool
  | Text of string
  | Place of Position.t
  | Places of Position.t list

type item = {
  word : string;  (** ["goPos"] *)
  arguments : (string * argument) list;  (** each by its name *)
}

type t = {
  name : string;
  vehicles : string list;  (** the only ones that may run it; [[]]: any *)
  items : item list;  (** in order, at least one *)
}

val required_payload : t -> string list
(** [required_payload m] is [["Camera"]] if an item takes photos, else [[]]. *)

val reference : t -> Position.t option
(** [reference m] is the first place that an item names; [None] if none does. *)

val is_numbered : item -> bool
(** Whether [jumpToItem] counts it: all items do something with the vehicle, but [arm] and [altitude]. *)

(** {1:way The way that a vehicle goes} *)

(** One item as a simulated vehicle carries it out. *)
type leg = {
  item : string;  (** its number and word, ["2.goPos"] *)
  waypoints : Position.t list;  (** visited in order *)
  level : Plan.level;  (** that of {!heights}, home being at height 0, where it lands; as before if not known *)
  dwell : float;  (** seconds at the last of them; [infinity] for an item without end *)
  speed : float;
  radius : float;  (** metres around the last of them within which it is done: those of its circles *)
}

val path : from:Position.t -> speed:float -> t -> leg list
(** [path ~from ~speed m] is the legs of a vehicle at [from], whose home is there and whose speed is [speed] until
    [m] sets another: a leg for each item that is carried out, in order, jumps taken. Of a stored mission nothing is
    known: it takes no time. A vehicle that circles without end as the last item is done once there; other missions
    without end end with a dwell without end. *)

(** A leg of {!path}, and how the vehicle came to it. *)
type step = {
  index : int;  (** of its item among the numbered ones, from 0 *)
  leg : leg;
  taken : (int * float) list;  (** the jumps under way, by their indices, and how often each was taken *)
}

val steps : from:Position.t -> speed:float -> t -> step list
(** [steps ~from ~speed m] is the steps of [path ~from ~speed m]. *)

val last_before_home : t -> Position.t option
(** [last_before_home m] is the last place of a way that is the same from anywhere, but for a last part that comes home:
    from there that part is of no length. [None] if no place is the same from anywhere, or another part is not. *)

val heights : t -> (string * float option) list
(** [heights m] is each numbered item, as in {!path}, with its metres above home: the last altitude, and the item's
    climb; [None] if it goes up again with each of several rounds. *)

val compare : t -> t -> int
(** A total order; missions are equal if all of their items are. *)

val pp : Format.formatter -> t -> unit
(** The mission's name and its items' words. *)
