(* Graphs of a million states: everything takes seconds of processor time, and nothing overflows the stack. The times
   are printed: [dune exec test/lts/test_large.exe -- -v]. *)

open Dolphin_lts
module Json = Dolphin_lts_json.Graph_json

let million = 1_000_000

(* No law of nature, but an order of magnitude above what it takes. *)
let limit = 60.

let timed name f =
  let start = Sys.time () in
  let result = f () in
  let elapsed = Sys.time () -. start in
  Printf.printf "%-50s %6.2f s\n%!" name elapsed;
  if elapsed > limit then Alcotest.failf "%s took %.0f s" name elapsed;
  result

let build transitions =
  let b = Graph.Builder.create () in
  transitions (fun s label s' -> Graph.Builder.add b s label s');
  Graph.Builder.finish b

let chain ?(last = "step") length =
  build (fun add ->
      for s = 0 to length - 2 do
        add s (if s = length - 2 then last else "step") (s + 1)
      done)

let ring length =
  build (fun add ->
      for s = 0 to length - 1 do
        add s "step" ((s + 1) mod length)
      done)

(* [side] by [side], in which two processes go on independently. *)
let grid ?(right = "right") ?(down = "down") side =
  build (fun add ->
      for row = 0 to side - 1 do
        for column = 0 to side - 1 do
          let s = (row * side) + column in
          if column < side - 1 then add s right (s + 1);
          if row < side - 1 then add s down (s + side)
        done
      done)

(* A pseudo-random graph with [degree] transitions a state. *)
let scattered ~degree states =
  let seed = ref 1 in
  let random n =
    seed := ((!seed * 1103515245) + 12345) land 0x3fffffff;
    (!seed lsr 8) mod n
  in
  build (fun add ->
      for s = 0 to states - 1 do
        for _ = 1 to degree do
          let label = String.make 1 (Char.chr (97 + random 3)) in
          add s label (random states)
        done
      done)

let check = Alcotest.(check int)

let partitions () =
  let blocks name g =
    timed ("minimise " ^ name) (fun () ->
        let p = Partition.strong g in
        Graph.states (Partition.quotient g p))
  in
  check "a chain: each state has its distance from the end" million (blocks "chain" (chain million));
  check "a ring: all alike" 1 (blocks "ring" (ring million));
  check "a grid: each state has its distances" million (blocks "grid" (grid 1000));
  check "a grid of one label: the distance from the corner" 1999
    (blocks "grid, one label" (grid ~right:"step" ~down:"step" 1000));
  let scattered = Reachability.trim (scattered ~degree:3 300_000) in
  let minimal = Partition.minimal scattered in
  check "scattered: the same again" (blocks "scattered, 300,000" scattered) (blocks "scattered, minimal" minimal)

let comparisons () =
  let difference = function Ok () -> Alcotest.fail "no difference" | Error difference -> difference in
  let { Compare.formula; traces } =
    difference (timed "compare chains" (fun () -> Compare.strong (chain million) (chain (million + 1))))
  in
  check "depth of the formula" million (Modal_formula.depth formula);
  Alcotest.(check bool) "it holds" true (Modal_formula.holds (chain million) 0 formula);
  (match traces with
   | Only (Right, trace) -> check "length of the trace" million (List.length trace)
   | Only (Left, _) | Same | Not_known -> Alcotest.fail "not the right one's trace");
  Alcotest.(check bool) "it prints" true (String.length (Fmt.str "%a" Modal_formula.pp formula) < 20_000);
  let isomorphic name g h = timed ("isomorphic " ^ name) (fun () -> Compare.isomorphic g h) in
  Alcotest.(check bool) "grids" true (isomorphic "grid" (grid 1000) (grid 1000) = Ok ());
  Alcotest.(check bool) "grids of one label" true
    (let g = grid ~right:"step" ~down:"step" 300 in
     isomorphic "grid, one label (300 by 300)" g (Graph.map_labels Fun.id g) = Ok ());
  let scattered = scattered ~degree:3 100_000 in
  let turned = Graph.map_labels Fun.id (Graph.reverse (Graph.reverse scattered)) in
  Alcotest.(check bool) "scattered" true (isomorphic "scattered, 100,000" scattered turned = Ok ());
  match (difference (isomorphic "chains" (chain million) (chain ~last:"end" million))).reason with
  | Enabled { trace; _ } -> check "the last step" (million - 2) (List.length trace)
  | Merged _ | Unmatched _ | No_matching | Undecided -> Alcotest.fail "not by what is enabled"

let formats () =
  let g = grid 1000 in
  let text = timed "write Aldebaran's text" (fun () -> Aldebaran.to_string g) in
  let same = function Ok h -> Graph.equal g h | Error _ -> false in
  Alcotest.(check bool) "Aldebaran" true (timed "read it" (fun () -> same (Aldebaran.of_string text)));
  let text = timed "write JSON" (fun () -> Json.to_string (Graph.with_text string_of_int g)) in
  let same = function Ok h -> Graph.equal g h | Error _ -> false in
  Alcotest.(check bool) "JSON" true (timed "read it" (fun () -> same (Json.of_string text)))

let () =
  let case = Generate.case in
  Alcotest.run "large"
    [
      ( "a million states",
        [
          case "partitions" partitions;
          case "comparisons" comparisons;
          case "formats" formats;
        ] );
    ]
