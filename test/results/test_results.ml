open Dolphin_results

let or_error of_value = Alcotest.(result of_value string)
let ints = or_error Alcotest.(list int)

(* Doubles; fails of numbers below 0, and counts how often it is asked. *)
let double asked x =
  incr asked;
  if x < 0 then Error (string_of_int x) else Ok (2 * x)

let in_order () =
  let asked = ref 0 in
  Alcotest.check ints "each" (Ok [ 2; 4; 6 ]) (Results.map (double asked) [ 1; 2; 3 ]);
  Alcotest.check ints "none" (Ok []) (Results.map (double asked) []);
  let several x = Results.map (double asked) (List.init x (fun _ -> x)) in
  Alcotest.check ints "joined" (Ok [ 2; 4; 4 ]) (Results.concat_map several [ 1; 0; 2 ]);
  Alcotest.check
    (or_error Alcotest.(list (pair string int)))
    "with keys"
    (Ok [ ("b", 2); ("a", 4) ])
    (Results.map_values (double asked) [ ("b", 1); ("a", 2) ]);
  Alcotest.check (or_error Alcotest.string) "from the left" (Ok "abc")
    (Results.fold (fun text c -> Ok (text ^ c)) "a" [ "b"; "c" ])

let the_first_error () =
  let asked = ref 0 in
  Alcotest.check ints "the first" (Error "-2") (Results.map (double asked) [ 1; -2; 3; -4 ]);
  Alcotest.(check int) "nothing is asked behind it" 2 !asked;
  Alcotest.check (or_error Alcotest.int) "of a fold" (Error "7 and 1")
    (Results.fold (fun sum x -> if x = 1 then Error (Printf.sprintf "%d and %d" sum x) else Ok (sum + x)) 0
       [ 3; 4; 1; 1 ])

let long_lists () =
  let n = 1_000_000 in
  Alcotest.(check (result int string)) "no stack is needed" (Ok n)
    (Result.map List.length (Results.map Result.ok (List.init n Fun.id)))

let () =
  let quick name test = Alcotest.test_case name `Quick test in
  Alcotest.run "results"
    [ ( "lists",
        [ quick "what is given is in order" in_order;
          quick "the first error ends it" the_first_error;
          quick "long lists" long_lists ] ) ]
