(** Explicit-state model checking of a {!System}, breadth first: each state is kept once, with the state that it was
    first reached from, and so a run to it as short as any.

    Under a monitor, each state is kept once for each set of automaton states that runs to it may be in: the product of
    the system with the negation of a formula. Runs that cannot violate the formula any more are not followed.

    Fairness is judged by the caller: here every cycle is a run.

    {[
      open Dolphin_checker

      (* Two processes, and a lock that each takes and gives back. A state is one word, above the bits that the search
         reserves: 0 if the lock is free, or the process, 1 or 2, that has it. *)
      module Lock = struct
        type t = { numbering : Numbering.t; mutable reserved : int }
        type via = unit
        type property = Nothing_is_forbidden

        exception Outgrown

        let create () = { numbering = Numbering.create (); reserved = 0 }
        let words _ = 1
        let holder t word = word lsr t.reserved

        let widen t ~reserved =
          let before = t.reserved in
          t.reserved <- reserved;
          fun old fresh -> fresh.(0) <- (old.(0) lsr before) lsl reserved

        let numbers t key f = f (holder t key.(0))
        let visit t (v : unit System.visitor) n = v.visit [| n lsl t.reserved |] 0 ()
        let initial t v = visit t v 0

        let expand t key v =
          let next = if holder t key.(0) = 0 then [ 1; 2 ] else [ 0 ] in
          List.iter (visit t v) next;
          List.length next

        let numbering t = t.numbering
        let check_fit _ = ()

        type findings = unit

        let findings _ = ()
        let add_findings _ () = ()
        let broken _ _ = None
        let is_end _ _ = false
        let may_cycle _ = true
        let is_anchor _ _ = true
        let valuation t _ key = holder t key.(0)
      end

      module Search = Breadth_first.Make (Lock)

      (* Whether all runs satisfy a formula of the propositions p1 and p2: process 1, process 2 holds the lock. *)
      let satisfy formula =
        let negation = Dolphin_ltl.Formula.(Not (Result.get_ok (of_string formula))) in
        let holds holder proposition = proposition = Printf.sprintf "p%d" holder in
        let monitor = Dolphin_ltl.(Monitor.create ~holds (Automaton.of_formula negation)) in
        let search = Search.create ~monitor Limits.none (Lock.create ()) in
        Search.run search;
        Search.formula search = Holds

      let () =
        let search = Search.create Limits.none (Lock.create ()) in
        Search.run search;
        assert (Search.count search = 3 && Search.no_deadlock search = Holds);
        assert (satisfy "G !(p1 & p2)");
        assert (not (satisfy "G F p1"))
    ]} *)

(** The findings about a property. *)
type 'run verdict =
  | Holds  (** all states were searched *)
  | Violated of 'run
  | Inconclusive of Limits.bound  (** no violation was found before this bound was met *)

(** States on a run without end. *)
type lasso = {
  stem : int list;  (** from the initial state *)
  around : int list;  (** from the last one of [stem] back to it *)
}

(** A run that violates a formula. *)
type violation =
  | Whatever_follows of int list  (** every run that starts through these states violates it, or may rest in the last *)
  | Around of { stem : int list; cycle : (int * int) list }
  (** [cycle] is arrivals in states, with valuations, that repeat without end after [stem] and come back to its last *)

(** The search of a system [S]. *)
module Make (S : System.S) : sig
  type t

  val create :
    ?compress:bool -> ?spill:string -> ?workers:int -> ?fork_from:int -> ?monitor:Dolphin_ltl.Monitor.t ->
    ?phase:string -> ?started:float -> Limits.t -> S.t -> t
  (** [create limits s] is the search of [s] with nothing but its initial state. [compress] is as for
      {!States.create}, [false] by default. [spill] is a directory where states go, if they are not compressed, once
      three quarters of [limits.max_memory] are taken; it is for {!run} alone, not for {!run_walks} or
      {!run_bitstate}. [workers], 1 by default, is how many processes {!run} uses from [fork_from] states on, 100,000
      by default: then the numbers of states depend on which of them comes first, and so does which of several
      shortest runs is shown. It uses one where states are compressed or may go to disk, and with [look] or [enough].
      Under a monitor the graph may be empty. It is empty, too, if the system cannot list its successors: then the
      search is {!stopped}. [phase] is the present phase, in reports of progress. [started] is as for
      {!Limits.guard}. *)

  val close : t -> unit
  (** [close t] gives back what [t] has on disk. Only what needs no state may be asked of it then: {!count}, {!memory},
      {!stopped} and the like. *)

  val run : ?watcher:Watcher.t -> ?look:(int -> unit) -> ?enough:(unit -> bool) -> t -> unit
  (** [run t] expands all states, until a bound is met, [enough ()] is true, or it {!is_violated} and no state less deep
      shows that. [watcher] sees each of them; [look i] is called before state [i] is expanded, in order, in one
      process. Exceptions of [S.expand], [look] and [enough] pass through, {!Limits.Stop} apart. *)

  val run_walks : ?look:(int -> unit) -> ?enough:(unit -> bool) -> t -> walks:int -> seed:int -> unit
  (** [run_walks t ~walks ~seed] is {!run} along random walks, as many as [walks], in place of all states: at each
      state one of the transitions is taken, any as likely as another; the states that the others lead to are seen,
      but not expanded. A walk ends at a state without transitions, or after [max_depth] of them, 10,000 by default.
      Unless all states have been expanded, it is stopped by {!Limits.Sampled} at the latest. [look i] is called
      before state [i] is expanded first. The search must be without a monitor. *)

  val run_bitstate : ?look:(int -> unit) -> ?enough:(unit -> bool) -> t -> bytes:int -> unit
  (** [run_bitstate t ~bytes] is {!run}, depth first and by {!Bitstate}, in an array of [bytes] bytes: bits of a hash
      alone distinguish states, and only the states on runs that are shown are kept. So it is stopped by
      {!Limits.Hashed} at the latest: [max_depth] is how deep it goes, and no bound that stops it. [look] is given
      {!here}. The search must be without a monitor. *)

  val here : int
  (** Stands, for {!run_bitstate}'s [look], for the state that it is at: {!load} knows it. *)

  val keep : t -> int -> int
  (** [keep t i] is [i], the number of a state; of {!here} it is the number by which that state is known from now on,
      with the run to it. *)

  val bitstate : t -> Bitstate.summary option
  (** The outcome of {!run_bitstate}. *)

  val sample : t -> Sample.summary option
  (** The outcome of the random walks. *)

  val expand : t -> int -> int
  (** [expand t i] expands state [i], and is the number of its transitions: for tests, in place of {!run}. States come
      in order. *)

  val flush : t -> unit
  (** All states that have been visited are now there. *)

  (** {1:findings What was found} *)

  val system : t -> S.t
  (** The system that is searched, with its findings. *)

  val stopped : t -> Limits.bound option
  (** The bound that ended the search early; [None] if no bound was met, or it has not ended. *)

  val count : t -> int
  (** The number of states so far, expanded or not. *)

  val iter : t -> (int -> unit) -> unit
  (** [iter t f] calls [f] with the number of each state: unless several processes have searched, these are those below
      [count t]. *)

  val transitions : t -> int
  (** The transitions of the expanded states, as {!System.S.expand} counts them. *)

  val expanded : t -> int
  (** The number of states that were expanded. *)

  val depth : t -> int
  (** The most transitions of a shortest run to an expanded state. *)

  val memory : t -> int
  (** Bytes, as [max_memory] counts them. *)

  val deadlock : t -> int option
  (** The first state that is not an end, and where a run may rest. *)

  val broken : t -> S.property -> int option
  (** The first state that breaks the property by being reached. *)

  val is_violated : t -> bool
  (** Whether a state has been found after which, or if a run rests there, the formula is violated. *)

  (** {1:verdicts Verdicts}

      Each a shortest run to the first state that shows the violation. *)

  val no_deadlock : t -> int list verdict
  (** No state is a {!deadlock}. *)

  val never : t -> S.property -> int list verdict
  (** [never t p] is that no state violates [p] by being reached. *)

  val termination : t -> exact:(int -> bool) -> lasso verdict
  (** The absence of a cycle; otherwise a cycle with a shortest run to it and the shortest way around. The run comes
      back to a state with [exact], for states that stand for others do not; such a state is on every cycle. *)

  val formula : t -> violation verdict
  (** That no run violates the formula of the monitor. *)

  val ticker : t -> string -> unit -> unit
  (** Code that searches the states again calls [ticker t phase] at each state: now and then it looks at the limits, and
      reports progress in [phase].
      @raise Limits.Stop *)

  val follow_up : t -> unit -> unit
  (** {!Limits.follow_up} of this search: for code that shows what was found. *)

  (** {1:states States} *)

  val load : t -> int -> int array
  (** [load t i] is the vector of state [i]. *)

  val set : t -> int -> int
  (** [set t i] is the number of the monitor's set in state [i]. *)

  val path : t -> int -> int list
  (** [path t i] is states from the initial one to [i], as few as can be; after {!run_bitstate}, of some run, and [i] is
      the last of one that is kept. *)

  (** The state [into] that a transition of number [action] leads to, with the [valuation] of the monitor there, 0
      without one. *)
  type arrival = { into : int; action : int; valuation : int; via : S.via }

  val visiting : t -> int -> (int array -> (int -> int -> unit) ref -> S.via System.visitor -> 'a) -> 'a
  (** [visiting t i f] is [f key arrived v]: [key] is the vector of state [i], to be expanded with [v], which calls
      [!arrived] with the number of each state that is visited, all of which are known, and the valuation, 0 without a
      monitor. With a monitor, states after which no violation is possible are left out. [f] may be called again. *)

  val arrivals : t -> int -> arrival list
  (** [arrivals t i] is the states that transitions of the expanded state [i] lead to, in order. *)
end
