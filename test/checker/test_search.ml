(* The checker on systems that are not Dolphin: philosophers at a table, with a known number of states and one deadlock,
   and a counter, with a known cycle and formulas with known verdicts. *)

open Dolphin_checker
open Dolphin_ltl

(* A system of vectors of small numbers, one word each, given by the successors of a vector. Words get a bit wider each
   time that a number does not fit, so that the search has to encode its states again. *)
module Vectors = struct
  type t = {
    start : int list;
    successors : int list -> int list list;
    is_end : bool;  (* whether a state that rests is not a deadlock *)
    is_broken : int -> bool;  (* of the first number *)
    mutable bits : int;  (* of a number *)
    mutable reserved : int;
    mutable outgrown : bool;  (* whether the next expansion outgrows the encoding, whatever it visits *)
    numbering : Numbering.t;
    is_known : bool;  (* whether the system knows its initial state *)
  }

  type via = unit
  type property = Too_large

  exception Outgrown

  let make ?(is_end = false) ?(is_broken = fun _ -> false) ?(is_known = true) start successors =
    { start; successors; is_end; is_broken; bits = 0; reserved = 0; outgrown = false;
      numbering = Numbering.create (); is_known }

  let words s = List.length s.start
  let first s word = word lsr s.reserved
  let read s key = List.mapi (fun w _ -> if w = 0 then first s key.(0) else key.(w)) s.start

  let write s key numbers =
    let put w n =
      if n >= 1 lsl s.bits then raise Outgrown;
      key.(w) <- (if w = 0 then n lsl s.reserved else n)
    in
    List.iteri put numbers

  let widen s ~reserved =
    let before = s.reserved in
    s.bits <- s.bits + 1;
    s.reserved <- reserved;
    s.outgrown <- false;
    fun old fresh ->
      Array.blit old 0 fresh 0 (Array.length old);
      fresh.(0) <- (old.(0) lsr before) lsl reserved

  let visit s (visitor : unit System.visitor) numbers =
    let key = Array.make (words s) 0 in
    write s key numbers;
    visitor.visit key 0 ()

  let initial s visitor =
    if not s.is_known then raise (Limits.Stop (Unsettled "what it is"));
    visit s visitor s.start

  let expand s key visitor =
    if s.outgrown then raise Outgrown;
    let next = s.successors (read s key) in
    List.iter (visit s visitor) next;
    if next = [] then visitor.rest ();
    List.length next

  let numbering s = s.numbering
  let check_fit _ = ()

  type findings = unit

  let findings _ = ()
  let add_findings _ () = ()
  let numbers s key f = List.iter f (read s key)
  let broken s word = if s.is_broken (first s word) then Some Too_large else None
  let is_end s _ = s.is_end
  let may_cycle _ = true
  let is_anchor _ _ = true

  (* The proposition holds where the first number is 3. *)
  let valuation s _ key = if first s key.(0) = 3 then 1 else 0
end

module Search = Breadth_first.Make (Vectors)

let searched ?compress ?spill ?workers ?monitor ?(limits = Limits.none) system =
  let search = Search.create ?compress ?spill ?workers ~fork_from:0 ?monitor limits system in
  Search.run search;
  search

let numbers search states = List.map (fun i -> Vectors.read (Search.system search) (Search.load search i)) states
let check_int = Alcotest.(check int)
let check_states = Alcotest.(check (list (list int)))

(* {1 Philosophers}

   Each thinks (0), has the left fork (1) or eats (2). An eating philosopher has the left fork of the next one, which
   then thinks. So the
   states are the words of 0, 1, 2 around a table in which 0 follows each 2, and all of them are reached. *)

let dine n table =
  let at i = List.nth table (i mod n) in
  let becomes i x = List.mapi (fun j y -> if j = i then x else y) table in
  let steps i =
    match at i with
    | 0 -> if at (i + n - 1) = 2 then [] else [ becomes i 1 ]
    | 1 -> if at (i + 1) = 0 then [ becomes i 2 ] else []
    | _ -> [ becomes i 0 ]
  in
  List.concat_map steps (List.init n Fun.id)

let philosophers n = Vectors.make (List.init n (fun _ -> 0)) (dine n)

(* The trace of the power of the matrix of allowed neighbours. *)
let tables n =
  let follows = [| [| 1; 1; 1 |]; [| 1; 1; 1 |]; [| 1; 0; 0 |] |] in
  let times a b =
    let entry i j = List.fold_left (fun sum k -> sum + (a.(i).(k) * b.(k).(j))) 0 [ 0; 1; 2 ] in
    Array.init 3 (fun i -> Array.init 3 (entry i))
  in
  let rec power k = if k = 1 then follows else times follows (power (k - 1)) in
  let p = power n in
  p.(0).(0) + p.(1).(1) + p.(2).(2)

(* States go to disk at once, and stay: four fifths of the memory are always taken. *)
let on_disk =
  let max_memory = 1_000_000_000_000 in
  { Limits.none with max_memory = Some max_memory; memory_taken = (fun () -> Some (max_memory / 5 * 4)) }

let folder = Filename.get_temp_dir_name ()

let test_philosophers ?compress ?spill ?workers ?limits n () =
  let search = searched ?compress ?spill ?workers ?limits (philosophers n) in
  check_int "states" (tables n) (Search.count search);
  check_int "all are expanded" (Search.count search) (Search.expanded search);
  match Search.no_deadlock search with
  | Violated path ->
    check_int "each takes one fork" (n + 1) (List.length path);
    check_states "nobody has two" [ List.init n (fun _ -> 1) ] (numbers search [ List.nth path n ])
  | Holds | Inconclusive _ -> Alcotest.fail "no deadlock was found"

(* {1 States that are values} *)

module Six = struct
  type state = int list
  type property = All_have_one

  let equal = List.equal Int.equal
  let hash = Hashtbl.hash
  let initial = List.init 6 (fun _ -> 0)
  let successors = dine 6
  let is_end _ = false
  let broken s = if List.for_all (Int.equal 1) s then Some All_have_one else None
  let letter = List.hd
end

module Six_system = Value_system.Make (Six)
module Six_search = Breadth_first.Make (Six_system)

let values ?workers ?monitor () =
  let search = Six_search.create ?workers ~fork_from:0 ?monitor Limits.none (Six_system.create ()) in
  Six_search.run search;
  search

let test_values ?workers () =
  let search = values ?workers () in
  check_int "states" (tables 6) (Six_search.count search);
  let state i = Six_system.state (Six_search.system search) (Six_search.load search i) in
  let known = ref [] in
  Six_search.iter search (fun i -> known := state i :: !known);
  check_int "each once" (tables 6) (List.length (List.sort_uniq compare !known));
  let shown = function
    | Breadth_first.Violated run ->
      let states = List.map state run in
      Alcotest.(check (list int)) "from the initial one" Six.initial (List.hd states);
      check_states "to where all have one" [ List.init 6 (fun _ -> 1) ] [ List.nth states 6 ];
      check_int "as short as any" 7 (List.length states)
    | Holds | Inconclusive _ -> Alcotest.fail "no deadlock was found"
  in
  shown (Six_search.no_deadlock search);
  shown (Six_search.never search All_have_one)

(* The first one eats only with a fork before. *)
let test_values_formula () =
  let holds letter name = letter = if name = "one" then 1 else 2 in
  let verdict text =
    let negation = Formula.Not (Result.get_ok (Formula.of_string text)) in
    let search = values ~monitor:(Monitor.create ~holds (Automaton.of_formula negation)) () in
    Six_search.formula search
  in
  Alcotest.(check bool) "one first" true (verdict "!two W one" = Holds);
  Alcotest.(check bool) "two in the end" false (verdict "F two" = Holds)

(* {1 A counter}

   From 0 up to 9, and from there back to 5. *)

let counter ?is_broken () =
  Vectors.make ?is_broken [ 0 ] (function [ 9 ] -> [ [ 5 ] ] | numbers -> [ List.map succ numbers ])

let range from upto = List.init (upto - from + 1) (fun i -> [ from + i ])

(* Looking for the cycle expands states again, and may outgrow their encoding. *)
let test_cycle ?spill ?workers ?limits ~outgrown () =
  let search = searched ?spill ?workers ?limits (counter ()) in
  (Search.system search).outgrown <- outgrown;
  check_int "states" 10 (Search.count search);
  check_int "transitions" 10 (Search.transitions search);
  Alcotest.(check bool) "no deadlock" true (Search.no_deadlock search = Holds);
  match Search.termination search ~exact:(fun _ -> true) with
  | Violated { stem; around } ->
    check_states "stem" (range 0 5) (numbers search stem);
    check_states "around" (range 5 9 @ [ [ 5 ] ]) (numbers search around)
  | Holds | Inconclusive _ -> Alcotest.fail "no cycle was found"

(* {1 Several processes}

   A state leads to a hundred others, and these to one. Their transitions depend on the process that expands
   them. The leader waits
   until a worker has begun: this one is sure to have some of the hundred, and to be the first at one. *)

let among_two ~worker ~leader =
  let here = Unix.getpid () and from, out = Unix.pipe () in
  let begun = ref false in
  let successors numbers =
    match numbers with
    | [ 0 ] -> List.init 100 (fun i -> [ i + 1 ])
    | [ n ] when n <= 100 ->
      if Unix.getpid () <> here then begin
        ignore (Unix.write_substring out "." 0 1 : int);
        worker n
      end
      else if !begun then leader n
      else begin
        begun := true;
        ignore (Unix.read from (Bytes.create 1) 0 1 : int);
        leader n
      end
    | _ -> []
  in
  Vectors.make ~is_end:true [ 0 ] successors

let last = [ [ 101 ] ]

let nobody_is_left () =
  match Unix.waitpid [ WNOHANG ] (-1) with
  | exception Unix.Unix_error (ECHILD, _, _) -> ()
  | _ -> Alcotest.fail "a process is left"

let test_workers () =
  let search = searched ~workers:2 (among_two ~worker:(fun _ -> last) ~leader:(fun _ -> last)) in
  check_int "states" 102 (Search.count search);
  check_int "transitions" 200 (Search.transitions search);
  check_int "all are expanded" 102 (Search.expanded search);
  check_int "depth" 2 (Search.depth search);
  let found = ref [] in
  Search.iter search (fun i -> found := Vectors.read (Search.system search) (Search.load search i) :: !found);
  check_states "each once" (List.init 102 (fun i -> [ i ])) (List.sort compare !found);
  let goes_there = ref 0 in
  let look i = match List.length (Search.path search i) with 1 | 2 | 3 -> incr goes_there | _ -> () in
  Search.iter search look;
  check_int "runs to all states" 102 !goes_there;
  nobody_is_left ();
  Search.close search

(* Whatever ends the search, all processes end. *)
let test_stopped why ~worker ?(leader = fun _ -> last) ?(limits = Limits.none) () =
  let search = searched ~workers:2 ~limits (among_two ~worker ~leader) in
  let told =
    match Search.stopped search with Some bound -> Format.asprintf "%a" Limits.pp_bound bound | None -> "nothing"
  in
  Alcotest.(check string) "what stopped it" why told;
  nobody_is_left ();
  Alcotest.(check bool) "nothing is said to hold" false (Search.no_deadlock search = Holds);
  Search.close search

let rec for_ever n =
  Unix.sleep 3_600;
  for_ever n

let kill_this _ =
  Unix.kill (Unix.getpid ()) Sys.sigkill;
  last

let interrupted_once_begun () =
  let begun = ref false in
  let leader _ = begun := true; last in
  test_stopped "it was interrupted" ~worker:for_ever ~leader
    ~limits:{ Limits.none with interrupted = (fun () -> !begun) }
    ()

exception Strange

(* It comes up again in the leader. *)
let test_strange () =
  match searched ~workers:2 (among_two ~worker:(fun _ -> raise Strange) ~leader:(fun _ -> raise Strange)) with
  | exception Strange -> nobody_is_left ()
  | _ -> Alcotest.fail "what a worker raises is lost"

(* The leader can do the steps that a worker cannot. *)
let test_left () =
  let search = searched ~workers:2 (among_two ~worker:(fun _ -> raise Strange) ~leader:(fun _ -> last)) in
  check_int "states" 102 (Search.count search);
  check_int "transitions" 200 (Search.transitions search);
  nobody_is_left ();
  Search.close search

let test_reached () =
  let search = searched (counter ~is_broken:(fun n -> n > 6) ()) in
  match Search.never search Too_large with
  | Violated path -> check_states "a shortest run" (range 0 7) (numbers search path)
  | Holds | Inconclusive _ -> Alcotest.fail "it is reached"

let test_bounds () =
  let stopped limits = Search.stopped (searched ~limits (counter ())) in
  let is name expected limits = Alcotest.(check bool) name true (stopped limits = expected) in
  is "states" (Some Limits.States) { Limits.none with max_states = Some 5 };
  is "exactly as many states" None { Limits.none with max_states = Some 10 };
  is "depth" (Some Limits.Depth) { Limits.none with max_depth = Some 4 };
  is "interruption" (Some Limits.Interruption) { Limits.none with interrupted = (fun () -> true) };
  let search = searched ~limits:{ Limits.none with max_states = Some 5 } (counter ()) in
  Alcotest.(check bool) "nothing is said to hold" true (Search.no_deadlock search = Inconclusive States)

(* A single expansion may have many transitions. *)
let test_wide () =
  let wide = Vectors.make ~is_end:true [ 0 ] (function [ 0 ] -> range 1 100_000 | _ -> []) in
  let search = searched ~limits:{ Limits.none with max_states = Some 1_000 } wide in
  Alcotest.(check bool) "it is stopped" true (Search.stopped search = Some States);
  Alcotest.(check bool) "before the expansion is done" true (Search.count search < 2_000);
  let search = searched wide in
  check_int "all states" 100_001 (Search.count search);
  Alcotest.(check bool) "an end is no deadlock" true (Search.no_deadlock search = Holds)

(* {1 Random walks} *)

let sampled ?(limits = Limits.none) system ~walks ~seed =
  let search = Search.create limits system in
  Search.run_walks search ~walks ~seed;
  search

let summary search =
  match Search.sample search with Some s -> s | None -> Alcotest.fail "there were walks"

(* Walks that have reached every state report it. *)
let test_everywhere () =
  let search = sampled (philosophers 5) ~walks:1_000 ~seed:1 in
  check_int "states" (tables 5) (Search.count search);
  check_int "all are expanded" (tables 5) (Search.expanded search);
  Alcotest.(check bool) "nothing is left out" true (Search.stopped search = None);
  Alcotest.(check (float 0.)) "nothing is estimated" (float_of_int (tables 5)) (summary search).states;
  let whole = searched (philosophers 5) in
  check_int "transitions" (Search.transitions whole) (Search.transitions search)

let test_some () =
  let limits = { Limits.none with max_depth = Some 20 } in
  let once seed = sampled ~limits (philosophers 12) ~walks:50 ~seed in
  let search = once 7 and again = once 7 and other = once 8 in
  Alcotest.(check bool) "it says so" true (Search.stopped search = Some Sampled);
  Alcotest.(check bool) "nothing is said to hold" true (Search.never search Too_large = Inconclusive Sampled);
  Alcotest.(check bool) "the same with the same seed" true (Search.sample search = Search.sample again);
  Alcotest.(check bool) "not with another" true (Search.count search <> Search.count other);
  let s = summary search in
  check_int "walks" 50 s.walks;
  Alcotest.(check bool) "each of 21 visits, or to a deadlock" true (s.steps > 50 * 12 && s.steps <= 50 * 21);
  Alcotest.(check bool) "some are not visited" true (s.visited < Search.count search && Search.count search < tables 12);
  Alcotest.(check bool) "a chance" true (0. < s.unvisited && s.unvisited < 1.);
  Alcotest.(check bool) "an estimate" true (float_of_int s.visited < s.states)

(* It counts its walks well: of 2 coins each walk visits the start and one of two ends. *)
let test_estimates () =
  let coin = Vectors.make ~is_end:true [ 0 ] (function [ 0 ] -> List.map (fun n -> [ n ]) [ 1; 2; 3; 4 ] | _ -> []) in
  let s = summary (sampled coin ~walks:2 ~seed:3) in
  check_int "visits" 4 s.steps;
  let ends = s.visited - 1 in
  let once = if ends = 2 then 2. else 0. and twice = if ends = 2 then 1. else 2. in
  Alcotest.(check (float 1e-9)) "chance" (once /. 4.) s.unvisited;
  let least = float_of_int s.visited +. (once *. (once -. 1.) /. (2. *. (twice +. 1.))) in
  Alcotest.(check (float 1e-9)) "states" (Float.max 5. least) s.states

(* A run that is shown leads from state to state, and to the one that it shows. *)
let test_walked_path () =
  let search = sampled (counter ~is_broken:(fun n -> n > 6) ()) ~walks:3 ~seed:1 in
  match Search.never search Too_large with
  | Violated path -> check_states "a run" (range 0 7) (numbers search path)
  | Holds | Inconclusive _ -> Alcotest.fail "it is reached"

(* {1 Bitstate hashing} *)

let hashed ?(limits = Limits.none) ?look ?(bytes = 1 lsl 20) system =
  let search = Search.create limits system in
  let look = Option.map (fun look -> look search) look in
  Search.run_bitstate ?look search ~bytes;
  search

let bits search = match Search.bitstate search with Some s -> s | None -> Alcotest.fail "there were bits"

(* With many bits, all states are found. *)
let test_hashed () =
  let search = hashed (philosophers 6) and whole = searched (philosophers 6) in
  check_int "states" (tables 6) (bits search).states;
  check_int "transitions" (Search.transitions whole) (Search.transitions search);
  Alcotest.(check bool) "it says so" true (Search.stopped search = Some Hashed);
  Alcotest.(check bool) "nothing is said to hold" true (Search.never search Too_large = Inconclusive Hashed);
  match Search.no_deadlock search with
  | Violated path ->
    let states = numbers search path in
    check_states "nobody has two" [ List.init 6 (fun _ -> 1) ] [ List.nth states (List.length states - 1) ];
    let rec follow = function
      | state :: (next :: _ as rest) ->
        Alcotest.(check bool) "a step" true (List.mem next ((philosophers 6).successors state));
        follow rest
      | [ _ ] | [] -> ()
    in
    follow states
  | Holds | Inconclusive _ -> Alcotest.fail "no deadlock was found"

(* Cycles that the path comes back to, from a state that may be one that stands for others. *)
let test_hashed_cycle () =
  let search = hashed (counter ()) in
  let is_shown exact stem around =
    match Search.termination search ~exact:(fun i -> exact (List.concat (numbers search [ i ]))) with
    | Violated lasso ->
      check_states "stem" stem (numbers search lasso.stem);
      check_states "around" around (numbers search lasso.around)
    | Holds | Inconclusive _ -> Alcotest.fail "no cycle was found"
  in
  is_shown (fun _ -> true) (range 0 5) (range 5 9 @ [ [ 5 ] ]);
  is_shown (fun state -> state = [ 7 ]) (range 0 7) (range 7 9 @ range 5 7);
  let alone = hashed (Vectors.make [ 0 ] (fun numbers -> [ numbers ])) in
  match Search.termination alone ~exact:(fun _ -> true) with
  | Violated { stem; around } -> Alcotest.(check (pair (list int) (list int))) "at rest" ([ 0 ], [ 0; 0 ]) (stem, around)
  | Holds | Inconclusive _ -> Alcotest.fail "no cycle was found"

let test_hashed_reached () =
  let search = hashed (counter ~is_broken:(fun n -> n > 6) ()) in
  (match Search.never search Too_large with
   | Violated path -> check_states "a run" (range 0 7) (numbers search path)
   | Holds | Inconclusive _ -> Alcotest.fail "it is reached");
  (* Steps that were undone are on no run. *)
  let tree = function [ 0 ] -> range 1 3 | [ 1 ] -> [ [ 9 ] ] | _ -> [] in
  let search = hashed (Vectors.make ~is_end:true ~is_broken:(fun n -> n = 9) [ 0 ] tree) in
  (match Search.never search Too_large with
   | Violated path -> check_states "another run" [ [ 0 ]; [ 1 ]; [ 9 ] ] (numbers search path)
   | Holds | Inconclusive _ -> Alcotest.fail "it is reached");
  let kept = ref None in
  let look search i =
    if numbers search [ i ] = [ [ 4 ] ] then kept := Some (Search.keep search i) in
  let search = hashed ~look (counter ()) in
  check_states "a state that was looked for" (range 0 4) (numbers search (Search.path search (Option.get !kept)))

let test_hashed_bounds () =
  let stopped limits = Search.stopped (hashed ~limits (philosophers 6)) in
  let is name expected limits = Alcotest.(check bool) name true (stopped limits = Some expected) in
  is "states" Limits.States { Limits.none with max_states = Some 5 };
  is "interruption" Limits.Interruption { Limits.none with interrupted = (fun () -> true) };
  is "bits that there is no room for" Limits.Memory { Limits.none with max_memory = Some 1_000 };
  let search = hashed ~limits:{ Limits.none with max_depth = Some 3 } (counter ()) in
  check_int "no deeper" 4 (bits search).states;
  let clock = let looks = ref 0. in fun () -> looks := !looks +. 1.; !looks in
  let search = hashed ~limits:{ Limits.none with timeout = Some 1.5; clock } (philosophers 10) in
  Alcotest.(check bool) "time" true (Search.stopped search = Some Time);
  Alcotest.(check bool) "amid the search" true (0 < (bits search).states && (bits search).states < tables 10)

(* The number of missed states is the reported one, within a tenth, and a single bit more than reported is set. *)
let test_omitted () =
  let t = Bitstate.create ~bytes:16_384 in
  let omitted = ref 0 in
  for n = 1 to 40_000 do
    Bitstate.begin_state t;
    Bitstate.add t 7;
    Bitstate.add t n;
    if Bitstate.is_marked t then incr omitted else Bitstate.mark t;
    assert (Bitstate.is_marked t)
  done;
  let s = Bitstate.summary t in
  check_int "states" 40_000 (s.states + !omitted);
  let near name expected found =
    if Float.abs (found -. expected) > 0.05 *. expected then Alcotest.failf "%s: %g, not %g" name found expected in
  near "omitted" (float_of_int !omitted) s.omitted;
  let bits = 8. *. 16_384. in
  near "bits" (1. -. ((1. -. (1. /. bits)) ** (3. *. float_of_int s.states))) s.filled;
  Alcotest.(check (float 1e-6)) "some, for sure" 1. s.omission

(* States differ in few and small numbers: no two of them have one hash. *)
let test_hashes () =
  let t = Bitstate.create ~bytes:1 and seen = Hashtbl.create 5_000 in
  let rec longer numbers length =
    Bitstate.begin_state t;
    List.iter (Bitstate.add t) (List.rev numbers);
    let hash = Bitstate.hash t in
    if Hashtbl.mem seen hash then Alcotest.fail "two states have one hash";
    Hashtbl.add seen hash ();
    if length < 4 then List.iter (fun n -> longer (n :: numbers) (length + 1)) (List.init 8 Fun.id)
  in
  longer [] 0

(* Of few states, the chance that one is left out is the sum over all of them. *)
let test_omission () =
  let t = Bitstate.create ~bytes:1_000 and expected = ref 0. in
  for n = 1 to 100 do
    Bitstate.begin_state t;
    Bitstate.add t n;
    expected := !expected +. ((Bitstate.summary t).filled ** 3.);
    if not (Bitstate.is_marked t) then Bitstate.mark t
  done;
  let s = Bitstate.summary t in
  check_int "all" 100 s.states;
  Alcotest.(check (float 1e-4)) "chance" !expected s.omission;
  Alcotest.(check (float 1e-4)) "states" !expected s.omitted

(* {1 Formulas} *)

let verdict system text =
  let f = match Formula.of_string text with Ok f -> f | Error why -> failwith why in
  let monitor = Monitor.create ~holds:(fun valuation _ -> valuation = 1) (Automaton.of_formula (Not f)) in
  let search = searched ~monitor system in
  (search, Search.formula search)

let test_holds system text () =
  match verdict system text with
  | _, Holds -> ()
  | _, (Violated _ | Inconclusive _) -> Alcotest.failf "%s does not hold" text

let test_violated text ~stem ~cycle () =
  match verdict (counter ()) text with
  | search, Violated (Whatever_follows path) ->
    check_states "path" stem (numbers search path);
    Alcotest.(check bool) "no cycle" true (cycle = [])
  | search, Violated (Around around) ->
    check_states "stem" stem (numbers search around.stem);
    check_states "cycle" cycle (numbers search (List.map fst around.cycle))
  | _, (Holds | Inconclusive _) -> Alcotest.failf "%s is not violated" text

(* Of a level with more states than are added at once, the last may rest, where the formula does not hold. The others
   lead to states, one step deeper, at which it cannot hold any more. *)
let wide () =
  let successors = function
    | [ 0 ] -> List.init 300 (fun i -> [ 10 + i ]) @ [ [ 1_000 ] ]
    | [ n ] when n < 1_000 -> [ [ 5_000 + n ] ]
    | _ -> []
  in
  Vectors.make ~is_end:true [ 0 ] successors

let test_soonest () =
  match verdict (wide ()) "(X X three) & F three" with
  | search, Violated (Whatever_follows path) -> check_states "path" [ [ 0 ]; [ 1_000 ] ] (numbers search path)
  | _, (Holds | Violated (Around _) | Inconclusive _) -> Alcotest.fail "it is not decided"

(* {1 Disk} *)

let stopped search = Option.map (Format.asprintf "%a" Limits.pp_bound) (Search.stopped search)
let check_stopped = Alcotest.(check (option string)) "stopped"

let test_no_folder () =
  let search = searched ~spill:"/nowhere" ~limits:on_disk (philosophers 5) in
  check_stopped (Some "/nowhere: no file can be made there") (stopped search)

let test_not_spilled () =
  let limits = { on_disk with memory_taken = (fun () -> Some 999_000_000_000) } in
  check_stopped (Some "the bound on memory was met") (stopped (searched ~limits (philosophers 5)))

let test_bound_on_disk () =
  let search = searched ~spill:folder ~limits:{ on_disk with max_states = Some 100 } (philosophers 8) in
  check_stopped (Some "the bound on states was met") (stopped search);
  let all = { on_disk with max_states = Some (tables 8) } in
  check_stopped None (stopped (searched ~spill:folder ~limits:all (philosophers 8)))

(* It rests at 3. *)
let resting () = Vectors.make ~is_end:true [ 0 ] (function [ 3 ] -> [] | numbers -> [ List.map succ numbers ])

(* A system without an initial state: nothing is searched, and no verdict is "holds". *)
let test_no_beginning () =
  let search = searched (Vectors.make ~is_known:false [ 0 ] (fun _ -> [])) in
  check_int "states" 0 (Search.count search);
  check_int "depth" 0 (Search.depth search);
  let is_inconclusive = function Breadth_first.Inconclusive (Limits.Unsettled "what it is") -> true | _ -> false in
  Alcotest.(check bool) "no deadlock" true (is_inconclusive (Search.no_deadlock search));
  Alcotest.(check bool) "never" true (is_inconclusive (Search.never search Too_large));
  Alcotest.(check bool) "termination" true (is_inconclusive (Search.termination search ~exact:(fun _ -> true)))

let () =
  let case name f = Alcotest.test_case name `Quick f in
  Alcotest.run "search"
    [
      ( "philosophers",
        [ case "five" (test_philosophers 5); case "eight" (test_philosophers 8);
          case "eight, compressed" (test_philosophers ~compress:true 8);
          case "eight, on disk" (test_philosophers ~spill:folder ~limits:on_disk 8);
          case "eight, by two" (test_philosophers ~workers:2 8);
          case "eight, by three" (test_philosophers ~workers:3 8) ] );
      ( "states that are values",
        [ case "six" (test_values ?workers:None); case "six, by two" (test_values ~workers:2);
          case "formulas" test_values_formula ] );
      ( "several processes",
        [ case "two" test_workers; case "the cycle of the counter" (fun () -> test_cycle ~workers:2 ~outgrown:false ());
          case "the same, after outgrowing" (fun () -> test_cycle ~workers:3 ~outgrown:true ());
          case "a worker is killed"
            (fun () -> test_stopped "a worker process ended early, killed" ~worker:kill_this ());
          case "Ctrl-C while a worker is at something" interrupted_once_begun;
          case "exceptions" test_strange; case "what is left to the leader" test_left ] );
      ( "disk",
        [ case "its cycle" (fun () -> test_cycle ~spill:folder ~limits:on_disk ~outgrown:false ());
          case "its cycle, after outgrowing" (fun () -> test_cycle ~spill:folder ~limits:on_disk ~outgrown:true ());
          case "no folder" test_no_folder; case "without, memory is a bound" test_not_spilled;
          case "still a bound" test_bound_on_disk ] );
      ( "counter",
        [ case "its cycle" (fun () -> test_cycle ~outgrown:false ());
          case "its cycle, after outgrowing" (fun () -> test_cycle ~outgrown:true ());
          case "a state that is reached" test_reached; case "bounds" test_bounds;
          case "a bound within an expansion" test_wide; case "no beginning" test_no_beginning ] );
      ( "random walks",
        [ case "everywhere" test_everywhere; case "not everywhere" test_some; case "estimates" test_estimates;
          case "a run that they show" test_walked_path ] );
      ( "bitstate hashing",
        [ case "many bits" test_hashed; case "cycles" test_hashed_cycle; case "reached" test_hashed_reached;
          case "bounds" test_hashed_bounds; case "what is left out" test_omitted;
          case "the chance that any is" test_omission; case "hashes of small numbers" test_hashes ] );
      ( "formulas",
        [ case "F three" (test_holds (counter ()) "F three"); case "F G !three" (test_holds (counter ()) "F G !three");
          case "three or not" (test_holds (counter ()) "G (three | !three)");
          case "F G three, at rest" (test_holds (resting ()) "F G three");
          case "the least deep violation is shown" test_soonest;
          case "G !three" (test_violated "G !three" ~stem:(range 0 3) ~cycle:[]);
          case "G F three" (test_violated "G F three" ~stem:(range 0 5) ~cycle:(range 6 9 @ [ [ 5 ] ])) ] );
    ]
