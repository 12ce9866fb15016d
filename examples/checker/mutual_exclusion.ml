(* Two processes that must not be in their critical sections at once, by Peterson's algorithm, and by a wrong one with
   the flags alone. An example for dolphin-checker, which lib/checker/README.md explains. *)

open Dolphin_checker

type place = Outside | Raised  (* its flag *) | Waiting | Inside
type state = { places : place * place; turn : int }
type property = Both_inside

(* [with_turn] is whether a process gives the turn to the other one before it waits. *)
module Model (Algorithm : sig
    val with_turn : bool
  end) =
struct
  type nonrec state = state
  type nonrec property = property

  let equal = ( = )
  let hash = Hashtbl.hash
  let initial = { places = (Outside, Outside); turn = 0 }
  let place s i = if i = 0 then fst s.places else snd s.places
  let move s i p = { s with places = (if i = 0 then (p, snd s.places) else (fst s.places, p)) }

  let next s i =
    let other = 1 - i in
    match place s i with
    | Outside -> [ move s i Raised ]
    | Raised -> [ { (move s i Waiting) with turn = (if Algorithm.with_turn then other else s.turn) } ]
    | Waiting ->
      let may_enter = place s other = Outside || (Algorithm.with_turn && s.turn = i) in
      if may_enter then [ move s i Inside ] else []
    | Inside -> [ move s i Outside ]

  let successors s = next s 0 @ next s 1
  let is_end _ = false
  let broken s = if s.places = (Inside, Inside) then Some Both_inside else None

  (* Of the propositions waits0, in0, waits1 and in1, a bit each. *)
  let letter s =
    let bits p = match p with Waiting -> 1 | Inside -> 2 | Outside | Raised -> 0 in
    bits (fst s.places) lor (bits (snd s.places) lsl 2)
end

let propositions = [ ("waits0", 1); ("in0", 2); ("waits1", 4); ("in1", 8) ]
let holds letter name = letter land List.assoc name propositions <> 0

let pp_place ppf p =
  Format.pp_print_string ppf
    (match p with Outside -> "outside" | Raised -> "raised" | Waiting -> "waiting" | Inside -> "inside")

let pp_state ppf s = Format.fprintf ppf "%a and %a" pp_place (fst s.places) pp_place (snd s.places)

module Check (Algorithm : sig
    val with_turn : bool
  end) =
struct
  module System = Value_system.Make (Model (Algorithm))
  module Search = Breadth_first.Make (System)

  let show search states =
    let state i = System.state (Search.system search) (Search.load search i) in
    List.iter (fun i -> Format.printf "    %a@." pp_state (state i)) states

  let verdict search name = function
    | Breadth_first.Holds -> Format.printf "  %s: holds@." name
    | Violated run -> Format.printf "  %s: violated by this run@." name; show search run
    | Inconclusive bound -> Format.printf "  %s: %a@." name Limits.pp_bound bound

  let formula text =
    let formula = Result.get_ok (Dolphin_ltl.Formula.of_string text) in
    let monitor = Dolphin_ltl.(Monitor.create ~holds (Automaton.of_formula (Formula.Not formula))) in
    let search = Search.create ~monitor Limits.none (System.create ()) in
    Search.run search;
    match Search.formula search with
    | Holds -> Format.printf "  %s: holds@." text
    | Violated (Whatever_follows run) -> Format.printf "  %s: violated by this run@." text; show search run
    | Violated (Around { stem; cycle }) ->
      Format.printf "  %s: violated by this run@." text;
      show search stem;
      Format.printf "  and around, without end@.";
      show search (List.map fst cycle)
    | Inconclusive bound -> Format.printf "  %s: %a@." text Limits.pp_bound bound

  let all name =
    let search = Search.create Limits.none (System.create ()) in
    Search.run search;
    Format.printf "%s: %d states, %d transitions@." name (Search.count search) (Search.transitions search);
    verdict search "no deadlock" (Search.no_deadlock search);
    verdict search "never both inside" (Search.never search Both_inside);
    (* While 0 waits, 1 enters once at most. *)
    formula "G (waits0 & in1 -> in1 W (!in1 W in0))";
    (* Even if the scheduler prefers 1, since 1 then waits for 0. *)
    formula "G (waits0 -> F in0)"
end

module Peterson = Check (struct let with_turn = true end)
module Flags_alone = Check (struct let with_turn = false end)

let () =
  Peterson.all "Peterson's algorithm";
  Flags_alone.all "Flags alone"
