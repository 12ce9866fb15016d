(* Intervals have their stated coverage: by the exact probabilities of all samples. Quantiles and bars are those of
   the definition. *)

open Dolphin_statistics

let close = Alcotest.float 1e-9

(* {1 Intervals} *)

(* Known in closed form: of n samples without a hit, the upper end p has (1 - p)^n = tail. *)
let test_closed_forms () =
  let none n = 1. -. (0.025 ** (1. /. Float.of_int n)) in
  let check n =
    let i = Share.interval ~level:0.95 ~hits:0 n and all = Share.interval ~level:0.95 ~hits:n n in
    Alcotest.check close "least of none" 0. i.least;
    Alcotest.check close "most of none" (none n) i.most;
    Alcotest.check close "most of all" 1. all.most;
    Alcotest.check close "least of all" (1. -. none n) all.least
  in
  List.iter check [ 1; 2; 10; 100; 10_000; 1_000_000 ];
  let nothing = Share.interval ~level:0.95 ~hits:0 0 in
  Alcotest.check close "of no samples" 0. nothing.least;
  Alcotest.check close "of no samples" 1. nothing.most

(* P(X = k), X hits of n. *)
let probability n p k =
  let rec choose n k = if k = 0 then 0. else choose (n - 1) (k - 1) +. log (Float.of_int n /. Float.of_int k) in
  exp (choose n k +. (Float.of_int k *. log p) +. (Float.of_int (n - k) *. Float.log1p (-.p)))

let sum f from until =
  List.fold_left (fun s k -> s +. f k) 0. (List.init (max 0 (until - from + 1)) (fun i -> from + i))

(* Each end is where the tail of the binomial distribution has half of the rest. *)
let interval_by_the_definition =
  let generator = QCheck2.Gen.(int_range 1 150 >>= fun n -> pair (return n) (int_range 0 n)) in
  Test_support.Property.case "the ends are those of the definition" generator
    ~print:(fun (n, k) -> Printf.sprintf "%d of %d" k n)
    (fun (n, k) ->
       let level = 0.9 in
       let i = Share.interval ~level ~hits:k n in
       let is_tail x = Float.abs (x -. ((1. -. level) /. 2.)) < 1e-9 in
       (k = 0 || is_tail (sum (probability n i.least) k n)) && (k = n || is_tail (sum (probability n i.most) 0 k)))

(* For each p: the samples whose interval contains it have the level together, or more. *)
let coverage =
  let generator = QCheck2.Gen.(pair (int_range 1 80) (float_range 0.001 0.999)) in
  Test_support.Property.case ~count:50 "intervals contain what they should as often as they say" generator
    ~print:(fun (n, p) -> Printf.sprintf "%d samples, p = %g" n p)
    (fun (n, p) ->
       let contains k =
         let { Share.least; most } = Share.interval ~level:0.95 ~hits:k n in
         least <= p && p <= most
       in
       sum (fun k -> if contains k then probability n p k else 0.) 0 n >= 0.95 -. 1e-9)

let test_looks () =
  let wrong = sum (fun j -> 1. -. Share.level_of_look ~level:0.95 j) 1 10_000 in
  Alcotest.(check bool) "all looks together" true (wrong <= 0.05 && wrong > 0.0499);
  Alcotest.(check (list int)) "sizes" [ 100; 125; 156; 195; 243 ] (List.init 5 (fun i -> Share.look (i + 1)))

(* {1 Distributions} *)

let test_quantiles () =
  let d = Distribution.of_list (List.rev (List.init 100 (fun i -> Float.of_int (i + 1)))) in
  let check q x = Alcotest.check close (string_of_float q) x (Distribution.quantile q d) in
  List.iter (fun (q, x) -> check q x) [ (0., 1.); (0.05, 5.); (0.5, 50.); (0.95, 95.); (0.951, 96.); (1., 100.) ];
  Alcotest.check close "of one" 7. (Distribution.quantile 0.05 (Distribution.of_list [ 7. ]))

let bins =
  let generator =
    let time = QCheck2.Gen.(map (fun ms -> Float.of_int ms /. 1000.) (int_bound 40_000_000)) in
    QCheck2.Gen.(pair (int_range 2 20) (list_size (int_range 1 60) time))
  in
  let print (most, xs) = Printf.sprintf "%d: %s" most (String.concat " " (List.map string_of_float xs)) in
  Test_support.Property.case "spans have all times, each once" generator ~print (fun (most, xs) ->
      let bins = Distribution.bins ~most (Distribution.of_list xs) in
      let is_in (b : Distribution.bin) x = b.from <= x && x < b.until in
      let rec follow : Distribution.bin list -> bool = function
        | a :: (b :: _ as rest) -> a.until = b.from && follow rest
        | [ _ ] | [] -> true
      in
      let last = List.nth bins (List.length bins - 1) in
      List.length bins <= most && follow bins
      && List.for_all (fun (b : Distribution.bin) -> b.count = List.length (List.filter (is_in b) xs)) bins
      && List.fold_left (fun n (b : Distribution.bin) -> n + b.count) 0 bins = List.length xs
      && (List.hd bins).count > 0 && last.count > 0)

let test_bins () =
  let widths ?(most = 4) xs =
    let bins = Distribution.bins ~most (Distribution.of_list xs) in
    List.map (fun (b : Distribution.bin) -> (b.from, b.until, b.count)) bins
  in
  let spans = Alcotest.(list (triple (float 0.) (float 0.) int)) in
  Alcotest.check spans "half minutes" [ (960., 990., 1); (990., 1020., 0); (1020., 1050., 1) ]
    (widths [ 965.; 1049.9 ]);
  Alcotest.check spans "of one time" [ (60., 60.001, 2) ] (widths [ 60.; 60. ]);
  Alcotest.check spans "none" [] (widths []);
  Alcotest.check spans "days" [ (0., 345_600., 2); (345_600., 691_200., 1) ] (widths ~most:2 [ 0.; 3600.; 400_000. ])

(* {1 Bars} *)

let bars = [ ("15:30 to 16:00", 3); ("16:00 to 16:30", 1200); ("16:30 to 17:00", 0); ("17:00 to 17:30", 600) ]

let test_bars () =
  let lines columns = Dolphin_display.Histogram.lines ~columns bars in
  let bar n = String.make n '#' in
  let expected n =
    [ "15:30 to 16:00     3  #"; "16:00 to 16:30  1200  " ^ bar n; "16:30 to 17:00     0";
      "17:00 to 17:30   600  " ^ bar ((n + 1) / 2) ]
  in
  Alcotest.(check (list string)) "60 columns" (expected 38) (lines 60);
  Alcotest.(check (list string)) "200 columns" (expected 100) (lines 200);
  Alcotest.(check (list string)) "5 columns" (expected 10) (lines 5);
  Alcotest.(check (list string)) "nothing" [] (Dolphin_display.Histogram.lines ~columns:80 [])

let () =
  let case name f = Alcotest.test_case name `Quick f in
  Alcotest.run "statistics"
    [ ("intervals",
       [ case "closed forms" test_closed_forms; interval_by_the_definition; coverage; case "looks" test_looks ]);
      ("distributions", [ case "quantiles" test_quantiles; bins; case "widths" test_bins ]);
      ("bars", [ case "at several widths" test_bars ]) ]
