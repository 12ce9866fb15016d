module type MODEL = sig
  type state

  val equal : state -> state -> bool
  val hash : state -> int
  val initial : state
  val successors : state -> state list
  val is_end : state -> bool

  type property

  val broken : state -> property option
  val letter : state -> int
end

module Make (M : MODEL) = struct
  module States = Interner.Make (struct
      type t = M.state

      let equal = M.equal
      let hash = M.hash
    end)

  type t = { numbering : Numbering.t; states : States.t; mutable reserved : int }
  type via = unit
  type property = M.property
  type findings = unit

  exception Outgrown

  let create () =
    let numbering = Numbering.create () in
    { numbering; states = States.create numbering; reserved = 0 }

  (* A vector is the number of its state, above the reserved bits. *)

  let words _ = 1
  let of_word t word = States.value t.states (word lsr t.reserved)
  let state t key = of_word t key.(0)

  let widen t ~reserved =
    let before = t.reserved in
    t.reserved <- reserved;
    fun old fresh -> fresh.(0) <- (old.(0) lsr before) lsl reserved

  let numbers t key f = f (key.(0) lsr t.reserved)
  let visit t (v : unit System.visitor) s = v.visit [| States.number t.states s lsl t.reserved |] 0 ()
  let initial t v = visit t v M.initial

  let expand t key (v : unit System.visitor) =
    let next = M.successors (state t key) in
    List.iter (visit t v) next;
    if next = [] then v.rest ();
    List.length next

  let numbering t = t.numbering
  let check_fit _ = ()
  let findings _ = ()
  let add_findings _ () = ()
  let broken t word = M.broken (of_word t word)
  let is_end t word = M.is_end (of_word t word)
  let may_cycle _ = true
  let is_anchor _ _ = true
  let valuation t _ key = M.letter (state t key)
end
