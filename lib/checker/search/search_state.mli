(** A search under way: the states that were found, how it arrives in more, and how one is expanded. All ways to search
    share it: {!Breadth_first}, {!Together}, {!Random_walks} and {!Depth_first}. *)

(** The search of a system [S]. *)
module Make (S : System.S) : sig
  (** Of a depth-first search by bitstate hashing. *)
  type deep = {
    bits : Bitstate.t;
    trail : Trail.t;
    runs : (int, int list) Hashtbl.t;  (** to states that are kept *)
    mutable cycle : (int list * int) option;  (** a run whose last state leads to the one at that place *)
  }

  (** Of a search that goes on in several processes. *)
  type shared = {
    team : Team.t;
    mutable expanded : int;  (** by processes that have ended, and by this one *)
    mutable findings : S.findings option;  (** in a worker that can find no more *)
  }

  (** A search. Its fields are for the modules named above; the functions below keep them consistent. *)
  type t = {
    system : S.t;
    limits : Limits.t;
    phase : string;
    monitor : Dolphin_ltl.Monitor.t option;
    mutable reserved : int;  (** bits of first words: for the number of the monitor's set *)
    mutable states : States.t;
    mutable key : int array;  (** the state being expanded *)
    mutable from : int;  (** the monitor's set in it *)
    mutable next : int;  (** to be expanded *)
    mutable depth : int;  (** of [next] *)
    mutable level_end : int;  (** the first state that is deeper *)
    mutable transitions : int;
    mutable work : int;  (** visits and expansions *)
    mutable allocated : float;  (** words by the last look around *)
    mutable deadlock : int;  (** the first such state, or -1; the fields below too *)
    mutable violation : int;
    mutable violation_depth : int;
    broken : (S.property, int) Hashtbl.t;
    mutable stopped : Limits.bound option;
    mutable sample : Sample.t option;
    mutable deep : deep option;
    mutable guard : Limits.guard;
    mutable spill : string option;  (** the store for states when memory runs short *)
    mutable workers : int;
    fork_from : int;  (** states *)
    mutable shared : shared option;
    fresh : int -> int -> unit;
    mutable watcher : Watcher.t option;  (** in a search of all states *)
    give : unit -> unit;  (** before the monitor gives a number *)
    visitor : S.via System.visitor;
  }

  val create :
    ?compress:bool -> ?spill:string -> ?workers:int -> ?fork_from:int -> ?monitor:Dolphin_ltl.Monitor.t ->
    ?phase:string -> ?started:float -> Limits.t -> S.t -> t
  (** As {!Breadth_first.Make.create}. *)

  val close : t -> unit
  (** As {!Breadth_first.Make.close}. *)

  (** {1 What was found} *)

  val system : t -> S.t
  (** As {!Breadth_first.Make.system}, and so are those below of the same names. *)

  val stopped : t -> Limits.bound option
  (** The bound that was met, if any. *)

  val count : t -> int
  (** The number of states so far. *)

  val iter : t -> (int -> unit) -> unit
  (** [iter t f] calls [f] with the number of each state. *)

  val transitions : t -> int
  (** The transitions of expanded states, those of running workers included. *)

  val expanded : t -> int
  (** The number of expanded states, those of running workers included; of walks, of visited states; of a depth-first
      search, of marked ones. *)

  val visited : deep -> int
  (** How many states bitstate hashing has marked. *)

  val sample : t -> Sample.summary option
  (** The outcome of random walks, if there were any. *)

  val bitstate : t -> Bitstate.summary option
  (** The outcome of bitstate hashing, if it was used. *)

  val depth : t -> int
  (** The most transitions of a shortest run to an expanded state; 0 before any is. *)

  val heap : unit -> int
  (** Bytes of this process's heap. *)

  val memory : t -> int
  (** Bytes: of the states, of the bits, and of the heaps of all processes. *)

  val found : int -> int option
  (** [found i] is [Some i] for the number of a state, [None] for -1. *)

  val deadlock : t -> int option
  (** The first deadlock that was found. *)

  val broken : t -> S.property -> int option
  (** [broken t p] is the first state that was found to violate [p]. *)

  val is_violated : t -> bool
  (** Whether a state was found after which the formula is violated. *)

  val is_settled : t -> bool
  (** Whether it {!is_violated} and no state less deep can show it. *)

  val path_to : t -> int -> int list
  (** [path_to t i] is states from the initial one to [i], by their parents. *)

  (** {1 Limits} *)

  val look_around : ?by:int -> t -> string -> unit
  (** [look_around t phase] looks at the limits, and at the other processes: a worker at these alone. [by] is how many
      states may be found until the next look.
      @raise Limits.Stop *)

  val look_at_limits : ?by:int -> t -> string -> unit
  (** The same, but not at other processes. *)

  val ticker : t -> string -> unit -> unit
  (** As {!Breadth_first.Make.ticker}. *)

  val follow_up : t -> unit -> unit
  (** As {!Breadth_first.Make.follow_up}. *)

  val worked : t -> unit
  (** Is called at each visit and each expansion: now and then it looks around. *)

  val check_states : t -> unit
  (** @raise Limits.Stop if there are more states than there may be. *)

  val see : t -> int -> unit
  (** [see t i] lets the watcher see state [i]. *)

  (** {1 States} *)

  val mask : t -> int
  (** The bits of first words that the number of the monitor's set has. *)

  val fetch : t -> int -> unit
  (** [fetch t i] makes state [i] the one that is expanded: sets [key] and [from]. *)

  val under : t -> Dolphin_ltl.Monitor.t -> int array -> int -> (int -> unit) -> unit
  (** [under t monitor key action put] is [put valuation] while [key] is with the monitor's set after it, if a violation
      is still possible.
      @raise S.Outgrown *)

  val arrive : t -> int array -> int -> unit
  (** [arrive t key action] adds the state that an action leads to, unless it is there: with others, at {!flush} at the
      latest. *)

  val flush : t -> unit
  (** Adds the states that have been arrived in and wait to be added. *)

  val widen : t -> unit
  (** Makes the fields of vectors as wide as they must be now, and rewrites all states. *)

  val widened : t -> int array -> int array
  (** {!widen}; the function that it gives does the same to a vector as it was before. *)

  val outgrow : t -> unit
  (** {!widen}, if there is room for it.
      @raise Limits.Stop *)

  val expand : t -> int -> int
  (** [expand t i] expands state [i], and is the number of its transitions. *)

  val more : t -> bool
  (** Whether a state is still to be expanded. *)

  val deeper : t -> unit
  (** Begins the next level.
      @raise Limits.Stop if it is as deep as the search may go. *)
end
