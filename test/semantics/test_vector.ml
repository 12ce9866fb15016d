open Dolphin_semantics
open Test_support

let case name f = Alcotest.test_case name `Quick f

(* {1 As lists are} *)

(* The operations on one of the vectors, known by its place modulo their number; the result is one more. *)
type operation = Append of int * int | Concat of int * int | Set of int * int | Map of int

let print = function
  | Append (at, x) -> Printf.sprintf "append %d %d" at x
  | Concat (at, other) -> Printf.sprintf "concat %d %d" at other
  | Set (at, i) -> Printf.sprintf "set %d %d" at i
  | Map at -> Printf.sprintf "map %d" at

let operations =
  let open QCheck2.Gen in
  let at = int_bound 1000 in
  let one =
    frequency
      [ (8, map2 (fun at x -> Append (at, x)) at small_nat);
        (1, map2 (fun at other -> Concat (at, other)) at at);
        (1, map2 (fun at i -> Set (at, i)) at at);
        (1, map (fun at -> Map at) at) ]
  in
  list_size (int_bound 60) one

(* Often the latest one is appended to, so that buffers fill up. *)
let nth pairs at = List.nth pairs (if at mod 3 = 0 then 0 else at mod List.length pairs)

(* Longer ones are left as they are: [Concat] may double them each time. *)
let longest = 2_000

let apply pairs operation =
  let made =
    match operation with
    | Append (at, x) ->
      let xs, list = nth pairs at in
      (Vector.append xs x, list @ [ x ])
    | Concat (at, other) ->
      let (xs, list), (ys, other) = nth pairs at, nth pairs other in
      if List.length list + List.length other > longest then (xs, list) else (Vector.concat xs ys, list @ other)
    | Set (at, i) ->
      let xs, list = nth pairs at in
      if list = [] then (xs, list)
      else
        let i = i mod List.length list in
        (Vector.set xs i (-1), List.mapi (fun j x -> if j = i then -1 else x) list)
    | Map at ->
      let xs, list = nth pairs at in
      (Vector.map succ xs, List.map succ list)
  in
  made :: pairs

let is_as (xs, list) =
  let at i = Vector.get xs i = List.nth list i in
  Vector.to_list xs = list
  && Array.to_list (Vector.to_array xs) = list
  && Vector.length xs = List.length list
  && (list = [] || (at 0 && at (List.length list - 1)))
  && Vector.exists (fun x -> x < 0) xs = List.exists (fun x -> x < 0) list
  && Vector.for_all (fun x -> x < 9) xs = List.for_all (fun x -> x < 9) list

let as_lists operations =
  let pairs = List.fold_left apply [ (Vector.empty, []) ] operations in
  List.for_all is_as pairs

let beyond () =
  let xs = Vector.append (Vector.of_list [ 1 ]) 2 in
  ignore (Vector.append xs 3);
  let missing i = match Vector.get xs i with _ -> false | exception Invalid_argument _ -> true in
  Alcotest.(check (list bool)) "no element" [ true; false; false; true ] (List.map missing [ -1; 0; 1; 2 ])

(* {1 Growth} *)

(* Bytes for each round of a loop of [n] rounds, with [body] in it. *)
let bytes_of_round (before, body) n =
  let program = Pure_run.compile_exn (Printf.sprintf "%s\nfor (i in 1..%d) { %s }" before n body) in
  let start = Gc.allocated_bytes () in
  let run = Pure_run.run program in
  let bytes = Gc.allocated_bytes () -. start in
  Alcotest.(check string) body "completed" (Pure_run.ending run);
  bytes /. float n

(* A value that is copied in each round takes eight times as many bytes a round for eight times as many rounds. *)
let is_linear code () =
  let few = bytes_of_round code 1_000 and many = bytes_of_round code 8_000 in
  if many > 2. *. few then Alcotest.failf "%.0f bytes a round for 1,000 rounds, %.0f for 8,000" few many

let growing =
  [ ("xs << x", ("xs = []", "xs << i"));
    ("xs.add(x)", ("xs = []", "xs.add(i)"));
    ("xs + x", ("xs = [0]", "xs = xs + i"));
    ("xs + [x]", ("xs = []", "xs = xs + [i]"));
    ("xs[xs.size()] = x", ("xs = []", "xs[xs.size()] = i"));
    ("m.k << x", ("m = [k: []]", "m.k << i"));
    ("what is asked of a list", ("xs = [0]", "xs << i + xs[-1] + xs.last() + xs.get(0) + xs.first() + xs.size"));
    ("whether it is empty", ("xs = [0]", "if (!xs.isEmpty() && xs) { xs << i }"));
    ("of a function", ("def f(xs, x) { xs << x\nreturn xs }\nxs = []", "xs = f(xs, i)"));
    ("in steps of their own", ("xs = []", "xs << i\nmessage i")) ]

let () =
  Alcotest.run "vectors"
    [ ( "as lists",
        [ Property.case ~count:1_000 "none changes when another one grows"
            ~print:(fun os -> String.concat "; " (List.map print os))
            operations as_lists;
          case "elements beyond the end" beyond ] );
      ("growth", List.map (fun (name, code) -> case name (is_linear code)) growing) ]
