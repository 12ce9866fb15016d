(* Zones are compared with the sets of whole valuations that they stand for, with dates up to 12. *)

open Dolphin_time

type operation = Delay | At_least of int * int | At_most of int * int | Arrange of int option list

let last_date = 12

let print_operation = function
  | Delay -> "delay"
  | At_least (i, n) -> Printf.sprintf "x%d >= %d" i n
  | At_most (i, n) -> Printf.sprintf "x%d <= %d" i n
  | Arrange from ->
    let place = function Some i -> Printf.sprintf "x%d" i | None -> "0" in
    Printf.sprintf "[%s]" (String.concat "; " (List.map place from))

let operation clocks =
  let open QCheck2.Gen in
  let clock = int_range 0 (clocks - 1) in
  let kept = if clocks = 1 then pure None else option (int_range 1 (clocks - 1)) in
  frequency
    [ (3, pure Delay); (2, map2 (fun i n -> At_least (i, n)) clock (int_range 0 6));
      (2, map2 (fun i n -> At_most (i, n)) clock (int_range 0 6));
      (3, map (fun from -> Arrange from) (list_size (int_range 0 3) kept)) ]

let operations =
  let open QCheck2.Gen in
  let rec more n clocks =
    if n = 0 then pure []
    else
      let* first = operation clocks in
      let clocks = match first with Arrange from -> List.length from + 1 | Delay | At_least _ | At_most _ -> clocks in
      let* rest = more (n - 1) clocks in
      pure (first :: rest)
  in
  let* n = int_range 1 8 in
  more n 1

let on_zone zone = function
  | Delay -> Some (Zone.delay zone)
  | At_least (i, n) -> Zone.at_least i n zone
  | At_most (i, n) -> Zone.at_most i n zone
  | Arrange from -> Some (Zone.rearranged (Array.of_list from) zone)

let on_points points = function
  | Delay ->
    let later xs = List.init (last_date - List.hd xs + 1) (fun d -> List.map (fun x -> x + d) xs) in
    List.sort_uniq compare (List.concat_map later points)
  | At_least (i, n) -> List.filter (fun xs -> List.nth xs i >= n) points
  | At_most (i, n) -> List.filter (fun xs -> List.nth xs i <= n) points
  | Arrange from ->
    let value xs = function Some i -> List.nth xs i | None -> 0 in
    List.sort_uniq compare (List.map (fun xs -> List.hd xs :: List.map (value xs) from) points)

(* Each zone on the way, with its points. *)
let rec all zone points = function
  | [] -> [ (zone, points) ]
  | first :: rest -> (
      let points' = on_points points first in
      match on_zone zone first with
      | Some zone' -> (zone, points) :: all zone' points' rest
      | None ->
        if points' <> [] then QCheck2.Test.fail_reportf "the zone is empty after %s" (print_operation first);
        [ (zone, points) ])

let after operations = all Zone.start [ [ 0 ] ] operations
let rec valuations n = if n = 0 then [ [] ] else
    List.concat_map (fun xs -> List.init (last_date + 1) (fun x -> x :: xs)) (valuations (n - 1))

let same_points (zone, points) =
  let holds xs = Zone.contains zone (Array.of_list xs) in
  let expected xs = List.mem xs points in
  let clocks = Zone.clocks zone in
  clocks > 3 || List.for_all (fun xs -> holds xs = expected xs) (valuations clocks)

let until_last zone = Zone.at_most 0 last_date zone

let same_dates (zone, points) =
  match until_last zone with
  | None -> points = []
  | Some zone ->
    let dates = List.map List.hd points in
    points <> []
    && Zone.earliest_date zone = List.fold_left min max_int dates
    && Zone.latest_date zone = Some (List.fold_left max 0 dates)

let put_off d = List.map (fun xs -> (List.hd xs + d) :: List.tl xs)
let are_among points = List.for_all (fun xs -> List.mem xs points)

(* Of all pairs with as many clocks. *)
let compared (operations, operations') =
  let bounded (zone, points) = Option.map (fun zone -> (zone, points)) (until_last zone) in
  let zones operations = List.filter_map bounded (after operations) in
  let pair (z, points) (z', points') =
    Zone.clocks z <> Zone.clocks z'
    || Zone.subset z z' = are_among points' points
       && Zone.equal z z' = (points = points')
       &&
       let by = Zone.delayed z z' in
       let fits d = are_among points' (put_off d points) in
       if by < 0 then not (List.exists fits (List.init (last_date + 1) Fun.id))
       else are_among points' (put_off by points) && not (are_among points' (put_off (by + 1) points))
  in
  List.for_all (fun a -> List.for_all (pair a) (zones operations')) (zones operations)

(* Ranks do not depend on the order of clocks, and a clock that is never younger than another one has a higher rank,
   or the same one if they are equal. *)
let ranked (operations, seed) =
  let check zone points =
    let count = Zone.clocks zone - 1 in
    let order =
      QCheck2.Gen.(generate1 ~rand:(Random.State.make [| seed |]) (shuffle_a (Array.init count Fun.id))) in
    let ranks = Zone.ranks zone in
    let others = Zone.ranks (Zone.rearranged (Array.map (fun i -> Some (i + 1)) order) zone) in
    let is_as_old i j = List.for_all (fun xs -> List.nth xs (i + 1) >= List.nth xs (j + 1)) points in
    let are_ranked i j =
      (not (is_as_old i j)) || if is_as_old j i then ranks.(i) = ranks.(j) else ranks.(i) > ranks.(j) in
    let clocks = List.init count Fun.id in
    List.for_all (fun k -> others.(k) = ranks.(order.(k))) clocks
    && List.for_all (fun i -> List.for_all (are_ranked i) clocks) clocks
  in
  List.for_all (fun (zone, points) -> Option.fold ~none:true ~some:(fun z -> check z points) (until_last zone))
    (after operations)

let print operations = String.concat ", " (List.map print_operation operations)
let print_both (a, b) = print a ^ " and " ^ print b

(* All dates before, or after, are there too, and nothing else. *)
let reaches operations =
  let check (zone, points) =
    let others xs = List.init (last_date + 1) (fun date -> date :: List.tl xs) in
    let kept keep xs = List.filter (fun ys -> keep (List.hd ys) (List.hd xs)) (others xs) in
    let with_others keep = List.concat_map (kept keep) points in
    let same zone points = same_points (zone, List.sort_uniq compare points) in
    match until_last zone with
    | None -> true
    | Some zone ->
      same (Zone.reaching_down zone) (with_others ( <= ))
      && same (Zone.reaching_up zone) (with_others ( >= ))
      && same (Zone.at_any_date zone) (with_others (fun _ _ -> true))
  in
  List.for_all check (after operations)

(* Clock 1 began at 2 at the latest, and is at 3 or less when clock 2 is there: that began at 5 at the latest, also when
   time has passed and clock 1 is forgotten. *)
let test_carried_over () =
  let operations =
    [ Delay; At_most (0, 2); Arrange [ None ]; Delay; At_most (0, 10); Arrange [ Some 1; None ]; At_most (1, 3); Delay;
      Arrange [ Some 2 ] ]
  in
  match List.rev (after operations) with
  | (zone, _) :: _ ->
    Alcotest.(check bool) "began at 5" true (Zone.contains zone [| 9; 4 |]);
    Alcotest.(check bool) "began at 6" false (Zone.contains zone [| 9; 3 |])
  | [] -> assert false

let () =
  let case name = Test_support.Property.case ~count:300 name in
  Alcotest.run "zone"
    [ ("against sets of valuations",
       [ case "operations" ~print operations (fun ops -> List.for_all same_points (after ops));
         case "dates" ~print operations (fun ops -> List.for_all same_dates (after ops));
         case "subset and delayed" ~print:print_both (QCheck2.Gen.pair operations operations) compared;
         case "ranks of clocks" ~print:(fun (ops, seed) -> Printf.sprintf "%s, %d" (print ops) seed)
           QCheck2.Gen.(pair operations (int_bound 1_000_000)) ranked;
         case "other dates" ~print operations reaches;
         Alcotest.test_case "a bound is carried over" `Quick test_carried_over ]) ]
