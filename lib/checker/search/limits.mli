(** The limits of a search, and its progress reports. *)

type t = {
  max_states : int option;
  max_depth : int option;  (** in transitions *)
  max_memory : int option;  (** in bytes, as [memory_taken] counts them *)
  memory_taken : unit -> int option;
  (** bytes of memory that the process has now, if that is known; asked often. If not, those of states and OCaml's heap
      are counted. *)
  memory_left : unit -> int option;
  (** bytes that the process can still have, if that is known; asked often. The search stops before it has nine tenths
      of all that it can have. *)
  timeout : float option;  (** in seconds of [clock] *)
  clock : unit -> float;  (** seconds, from any start *)
  interrupted : unit -> bool;  (** asked often: whether to stop *)
  progress : progress -> unit;  (** called about once a second *)
}

(** The state of a search, as its progress reports show it. *)
and progress = {
  phase : string;  (** the present phase *)
  states : int;
  rate : float;  (** states a second, since the start *)
  frontier : int;  (** states still to be expanded *)
  depth : int;
  memory : int;  (** bytes *)
  elapsed : float;  (** seconds *)
}

val none : t
(** No bounds, [Sys.time], no reports. *)

(** Why a search came to no end. *)
type bound =
  | States
  | Depth
  | Memory
  | No_memory  (** the machine has no more *)
  | Time
  | Interruption
  | Sampled  (** random walks have left out some states *)
  | Hashed  (** states were distinguished by bits of a hash, which may have left out some *)
  | Unsettled of string  (** something that was asked has no answer, for this reason *)

exception Stop of bound
(** A bound was met: the search ends there. *)

val pp_bound : Format.formatter -> bound -> unit
(** ["the time was up"] *)

val exceeds : int option -> int -> bool
(** [exceeds bound n] is whether [n] is more than [bound]. *)

(** {1:guards Guards} *)

type guard
(** Looks whether a search is within its limits. *)

val guard : ?started:float -> t -> guard
(** [guard ~started t] looks after what started when [t.clock] showed [started]: now by default. *)

val started : guard -> float
(** The time of [clock] from which seconds count. *)

(** How far a search has come. *)
type measures = {
  states : int;
  expanded : int;
  depth : int;
  used : int;  (** bytes in use *)
  growth : int;  (** bytes that may be taken until the guard looks again *)
}

val weigh : guard -> used:int -> int -> unit
(** [weigh g ~used n] looks whether [n] bytes more than [used] may be taken.
    @raise Stop if not. *)

val look : guard -> string -> measures -> unit
(** [look g phase m] looks at all limits but those on states and depth, and reports progress in [phase] if it is time
    to. It takes about a microsecond.
    @raise Stop *)

(** {1:after After a search} *)

val follow_up : ?stopped:bound -> ?used:(unit -> int) -> started:float -> t -> unit -> unit
(** [follow_up ~stopped ~used ~started limits] is a function to be called again and again in the work after a search
    that began at [started], such as the reconstruction of the runs that it found. [stopped] is the bound that ended
    the search, if one did; [used ()] is the bytes in use: by default, those of OCaml's heap. The work has the rest of
    the search's time, or if that is more, a second and a tenth of [limits.timeout], whichever is more; and the rest of
    its memory, or an eighth of [limits.max_memory] more than is in use at the beginning. If the search was
    interrupted, the work has one second.
    @raise Stop when that is over, or if the work is interrupted *)
