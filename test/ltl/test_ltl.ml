open Dolphin_ltl
module Gen = QCheck2.Gen
module Linear = Test_support.Linear
module Product_search = Test_support.Product_search

(* {1 Random formulas and graphs} *)

let propositions = 3

let formula = Linear.formula Gen.(int_bound (propositions - 1))
let letter = Gen.(map (List.filter_map Fun.id) (flatten_l (List.init propositions (fun p -> opt (return p)))))

let holds_of = Linear.holds (fun letter p -> List.mem p letter)

let word =
  let open Gen in
  let* n = int_range 1 6 in
  let* letters = array_size (return n) letter in
  map (fun back : int list Linear.word -> { letters; back }) (int_bound (n - 1))

(* Letters are on arrivals, as in state graphs with labels. *)
type graph = { first : int list; edges : (int * int list) list array }

let graph =
  let open Gen in
  let* n = int_range 1 5 in
  let edge = pair (int_bound (n - 1)) letter in
  let* first = letter in
  map (fun edges -> { first; edges }) (array_size (return n) (list_size (int_range 1 3) edge))

let search (g : graph) f =
  let holds letter p = List.mem p letter in
  Product_search.satisfying ~holds { start = (0, g.first); successors = (fun s -> g.edges.(s)) } f

let graph_of_word ({ letters; back } : int list Linear.word) =
  let n = Array.length letters in
  let edge i =
    let j = if i = n - 1 then back else i + 1 in
    [ (j, letters.(j)) ]
  in
  { first = letters.(0); edges = Array.init n edge }

let word_of_lasso ({ stem; cycle } : int list Product_search.lasso) : int list Linear.word =
  let stem = List.map snd stem and cycle = List.map snd cycle in
  { letters = Array.of_list (stem @ cycle); back = List.length stem }

let show f = Format.asprintf "%a" (Formula.pp (fun ppf p -> Format.fprintf ppf "p%d" p)) f
let property = Test_support.Property.case

(* {1 Laws} *)

let one_word (w, f) = (search (graph_of_word w) f <> None) = holds_of w f

let is_path g lasso =
  let rec connected from = function
    | [] -> true
    | arrival :: rest -> List.mem arrival g.edges.(from) && connected (fst arrival) rest
  in
  let { Product_search.stem; cycle } = lasso in
  match stem with
  | first :: rest ->
    let last xs = fst (List.nth xs (List.length xs - 1)) in
    first = (0, g.first) && connected 0 rest && cycle <> [] && connected (last stem) cycle && last cycle = last stem
  | [] -> false

let found_runs_satisfy (g, f) =
  match search g f with
  | None -> true
  | Some lasso -> is_path g lasso && holds_of (word_of_lasso lasso) f

(* Every run that goes around some cycle satisfies what no run violates. *)
let no_run_is_missed (g, f, choices) =
  search g f <> None
  ||
  let rec walk state trail = function
    | [] -> true
    | choice :: rest ->
      let target, letter = List.nth g.edges.(state) (choice mod List.length g.edges.(state)) in
      let trail = (target, letter) :: trail in
      let states = List.rev trail in
      let around i (s, _) =
        s <> target || i = List.length states - 1
        || not (holds_of { letters = Array.of_list (List.map snd states); back = i + 1 } f)
      in
      List.for_all Fun.id (List.mapi around states) && walk target trail rest
  in
  walk 0 [ (0, g.first) ] choices

(* A word that repeats its last letter, as the monitor sees it: letters are numbers, with a bit for each proposition. *)
let monitor_agrees (letters, f) =
  let number letter = List.fold_left (fun n p -> n lor (1 lsl p)) 0 letter in
  let holds letter p = letter land (1 lsl p) <> 0 in
  let monitor = Monitor.create ~holds (Automaton.of_formula f) in
  let read set letter = if set < 0 then set else Monitor.next monitor ~give:ignore set (number letter) in
  let sets = List.fold_left (fun sets l -> read (List.hd sets) l :: sets) [ Monitor.start ] letters in
  let last = List.hd sets in
  let expected = holds_of { letters = Array.of_list letters; back = List.length letters - 1 } f in
  let is_certain set = set >= 0 && Monitor.is_certain monitor set in
  let stays = last >= 0 && Monitor.stays monitor last (number (List.nth letters (List.length letters - 1))) in
  stays = expected && ((not (List.exists is_certain sets)) || expected)

(* All words over the propositions. *)
let every_word =
  let subsets = List.fold_left (fun sets p -> sets @ List.map (fun s -> p :: s) sets) [ [] ] [ 0; 1; 2 ] in
  let edges = List.mapi (fun i letter -> (i, letter)) subsets in
  { first = []; edges = Array.make (List.length subsets) edges }

let are_equivalent f g =
  (* After the first letter, which is fixed. *)
  search every_word (Next (Not (Equivalent (f, g)))) = None

let equivalences =
  [ ("F p", "true U p"); ("G p", "!F !p"); ("G p", "false R p"); ("p R q", "!(!p U !q)"); ("p W q", "(p U q) | G p");
    ("p W q", "q R (p | q)"); ("p U q", "(p W q) & F q"); ("F p", "p | X F p"); ("G p", "p & X G p");
    ("p U q", "q | p & X (p U q)"); ("p R q", "q & (p | X (p R q))"); ("F F p", "F p"); ("G G p", "G p");
    ("p U (p U q)", "p U q"); ("F G F p", "G F p"); ("G F G p", "F G p"); ("G (p & q)", "G p & G q");
    ("F (p | q)", "F p | F q"); ("X (p U q)", "X p U X q"); ("G F (p | q)", "G F p | G F q");
    ("!X p", "X !p"); ("(p | q) U r -> F r", "true"); ("p -> q", "!p | q"); ("p <-> q", "p & q | !p & !q") ]

let differences =
  [ ("F G p", "G F p"); ("p U q", "p W q"); ("F (p & q)", "F p & F q"); ("G (p | q)", "G p | G q"); ("p", "X p");
    ("G F (p & q)", "G F p & G F q") ]

let formula_of text =
  let number = function "p" -> 0 | "q" -> 1 | "r" -> 2 | other -> invalid_arg other in
  match Formula.of_string text with Ok f -> Formula.map number f | Error why -> invalid_arg (text ^ ": " ^ why)

let pair_case expected (f, g) =
  let check () = Alcotest.(check bool) f expected (are_equivalent (formula_of f) (formula_of g)) in
  Alcotest.test_case (Printf.sprintf "%s %s %s" f (if expected then "is" else "is not") g) `Quick check

(* {1 Cycles} *)

let links =
  let open Gen in
  let* n = int_range 1 9 in
  array_size (return n) (list_size (int_bound 3) (int_bound (n - 1)))

(* By the definition: the nodes that are reached from one in one step or more. *)
let reached links i =
  let seen = Array.make (Array.length links) false in
  let rec visit j =
    if not seen.(j) then begin
      seen.(j) <- true;
      List.iter visit links.(j)
    end
  in
  List.iter visit links.(i);
  fun j -> seen.(j)

let cycles_are_those_by_definition links =
  let graph : unit Cycles.graph =
    { successors = (fun i -> List.map (fun j -> (j, ())) links.(i)); sets = 0; is_in = (fun _ _ -> false) } in
  let on_cycle = Cycles.on_cycles graph [ 0 ] and from_start = reached links 0 in
  let is_right i = on_cycle i = ((i = 0 || from_start i) && reached links i i) in
  List.for_all is_right (List.init (Array.length links) Fun.id)
  && Option.is_some (Cycles.find graph [ 0 ]) = List.exists on_cycle (List.init (Array.length links) Fun.id)

(* {1 Text} *)

let reads =
  [ ("G (start(survey1) -> F done(survey1))", "G (start(survey1) -> F done(survey1))");
    ("a & b | c -> d <-> e", "((((a & b) | c) -> d) <-> e)"); ("a -> b -> c", "(a -> (b -> c))");
    ("a U b U c & d", "((a U (b U c)) & d)"); ("!a U X b", "(!a U X b)"); ("F done(a, x8-02)->b", "(F done(a, x8-02) -> b)");
    ("G {n < 3 && f('}')} && true", "(G {n < 3 && f('}')} & true)"); ("not a || false", "(!a | false)") ]

let refused =
  [ ("", "a formula is expected at the end"); ("G", "a formula is expected at the end");
    ("a b", "an operator is expected before 'b'"); ("(a", "a ')' is missing"); ("poll(a", "the ( is not closed");
    ("a & ? b", "unexpected '?'"); ("(a b)", "')' is expected before 'b'") ]

let shown = function
  | Ok f -> Format.asprintf "%a" (Formula.pp Format.pp_print_string) f
  | Error why -> "error: " ^ why

let read_case (text, expected) =
  Alcotest.test_case text `Quick (fun () -> Alcotest.(check string) text expected (shown (Formula.of_string text)))

let read_back f =
  let text = Format.asprintf "%a" (Formula.pp (fun ppf p -> Format.fprintf ppf "p%d" p)) f in
  shown (Formula.of_string text) = text

let () =
  let print_pair (_, f) = show f and print_triple (_, f, _) = show f in
  Alcotest.run "ltl"
    [ ("text", List.map read_case (reads @ List.map (fun (text, why) -> (text, "error: " ^ why)) refused));
      ("equivalences", List.map (pair_case true) equivalences);
      ("differences", List.map (pair_case false) differences);
      ( "random",
        [ property "what is printed is read as the same" ~count:500 formula ~print:show read_back;
          property "a word satisfies what the definitions say" ~count:3_000 (Gen.pair word formula) ~print:print_pair one_word;
          property "a run that is found is one, and satisfies" ~count:3_000 (Gen.pair graph formula) ~print:print_pair
            found_runs_satisfy;
          property "a monitor knows what can become of a word" ~count:3_000
            Gen.(pair (list_size (int_range 1 5) letter) formula)
            ~print:print_pair monitor_agrees;
          property "the nodes on cycles are those that reach themselves" ~count:3_000 links
            ~print:QCheck2.Print.(array (list int)) cycles_are_those_by_definition;
          property "no run is missed" ~count:2_000
            (Gen.triple graph formula Gen.(list_size (return 8) (int_bound 5)))
            ~print:print_triple no_run_is_missed ] ) ]
