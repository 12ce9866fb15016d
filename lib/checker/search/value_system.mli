(** Systems whose states are values of any type. The shortest way to a {!System.S}: {!Make} numbers the states, and a
    vector is the number of its state.

    The values of all states stay in memory, whatever the search does with vectors: compression, the disk, bitstate
    hashing and further processes gain nothing. A system with millions of states needs an encoding of its own.

    {[
      open Dolphin_checker

      (* A ferryman has a wolf, a goat and a cabbage. A state: the things on the near bank, and whether he is there. *)
      module Ferry = struct
        type state = { near : string list; here : bool }

        let equal = ( = )
        let hash = Hashtbl.hash
        let all = [ "cabbage"; "goat"; "wolf" ]
        let initial = { near = all; here = true }
        let on_far s = List.filter (fun x -> not (List.mem x s.near)) all

        let successors s =
          let cross x =
            let near = if s.here then List.filter (( <> ) x) s.near else List.sort compare (x :: s.near) in
            { near; here = not s.here }
          in
          { s with here = not s.here } :: List.map cross (if s.here then s.near else on_far s)

        let is_end _ = true

        type property = Nothing_is_forbidden

        let broken _ = None

        (* 1 where something is eaten, 2 where all is across. *)
        let letter s =
          let alone = if s.here then on_far s else s.near in
          if List.mem "goat" alone && List.length alone > 1 then 1 else if s.near = [] then 2 else 0
      end

      module System = Value_system.Make (Ferry)
      module Search = Breadth_first.Make (System)

      let () =
        let formula = Result.get_ok (Dolphin_ltl.Formula.of_string "G !across | (!across U eaten)") in
        let holds letter proposition = letter = if proposition = "eaten" then 1 else 2 in
        let monitor = Dolphin_ltl.(Monitor.create ~holds (Automaton.of_formula (Not formula))) in
        let search = Search.create ~monitor Limits.none (System.create ()) in
        Search.run search;
        match Search.formula search with
        | Violated (Whatever_follows run | Around { stem = run; _ }) ->
          let at i = System.state (Search.system search) (Search.load search i) in
          let last = at (List.nth run (List.length run - 1)) in
          assert (List.length run = 8 && last.near = [])
        | Holds | Inconclusive _ -> assert false
    ]} *)

(** A system as its author writes it. *)
module type MODEL = sig
  type state
  (** A state of the system. *)

  val equal : state -> state -> bool
  (** States that are equal are one state. *)

  val hash : state -> int
  (** Equal states have equal hashes. *)

  val initial : state
  (** Where each run begins. *)

  val successors : state -> state list
  (** The states after one transition. A run without one rests where it is. *)

  val is_end : state -> bool
  (** Whether a run may rest here without being in a deadlock. *)

  type property
  (** A property that states violate by being reached: a constructor without arguments, or the like. *)

  val broken : state -> property option
  (** The property that the state violates, if it does. *)

  val letter : state -> int
  (** A number, from 0, that determines the propositions that hold in the state: the letter that {!Dolphin_ltl.Monitor}
      reads. Asked under a monitor only. *)
end

(** The system of a model. *)
module Make (M : MODEL) : sig
  include System.S with type via = unit and type property = M.property and type findings = unit

  val create : unit -> t
  (** The system before its search. Each search needs one of its own. *)

  val state : t -> int array -> M.state
  (** [state t key] is the state whose vector is [key]. *)
end
