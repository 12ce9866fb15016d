open Dolphin_assignment.Assignment

let random = Random.State.make [| 2016 |]

let metres bound = Random.State.float random bound

let leaf vehicles cost =
  Leaf (listed (List.map (fun vehicle -> (vehicle, cost vehicle)) vehicles))

let range first count = List.init count (fun index -> first + index)

let many count make = List.init count make

(* [count] parallel tasks at random places, for [count] vehicles at other places, all in a square. *)
let places count side =
  let place _ = (metres side, metres side) in
  let vehicles = Array.init count place in
  let task _ =
    let x, y = place () in
    leaf (range 0 count) (fun vehicle -> hypot (fst vehicles.(vehicle) -. x) (snd vehicles.(vehicle) -. y))
  in
  Disjoint (many count task)

let alike count cost = Disjoint (many count (fun _ -> leaf (range 0 count) cost))

let random_costs count = Disjoint (many count (fun _ -> leaf (range 0 count) (fun _ -> metres 1000.)))

(* Tasks and vehicles in ten harbours, so that ties abound but not everywhere. *)
let harbours count =
  let vehicles = Array.init count (fun _ -> Random.State.int random 10) in
  let task _ =
    let harbour = Random.State.int random 10 in
    leaf (range 0 count) (fun vehicle -> 1000. *. float_of_int (abs (vehicles.(vehicle) - harbour)))
  in
  Disjoint (many count task)

(* A cost that is a product makes shortest augmenting paths long. *)
let products count =
  Disjoint (many count (fun i -> leaf (range 0 count) (fun j -> float_of_int ((i + 1) * (j + 1)) /. 1000.)))

(* Fifty survey boats, while one of ten aircraft does fifty flights one by one. *)
let boats_and_aircraft () =
  let boats = many 50 (fun _ -> leaf (range 0 60) (fun _ -> metres 1000.)) in
  let flights = many 50 (fun _ -> leaf (range 60 10) (fun _ -> metres 1000.)) in
  Disjoint (boats @ [ Shared flights ])

(* Each branch first wants a vehicle of one type, then one of another. *)
let two_types branches =
  let branch _ =
    Shared
      [ leaf (range 0 branches) (fun _ -> metres 1000.); leaf (range branches branches) (fun _ -> metres 1000.) ]
  in
  Disjoint (many branches branch)

(* Stages of parallel tasks, one after the other. *)
let stages count width vehicles cost =
  Shared (many count (fun _ -> Disjoint (many width (fun _ -> leaf (range 0 vehicles) cost))))

(* Branches that want a sonar, then a camera; of five vehicles, two have a sonar, two a camera, and one has both. *)
let two_payloads branches cost =
  let half = branches / 2 in
  let branch _ = Shared [ leaf (range 0 (3 * half)) cost; leaf (range (2 * half) (3 * half)) cost ] in
  Disjoint (many branches branch)

let chain length =
  let rec build tree length =
    if length = 0 then tree else build (Shared [ leaf (range 0 10) (fun _ -> metres 100.); tree ]) (length - 1)
  in
  build (leaf (range 0 10) (fun _ -> 0.)) length

let too_few count = Disjoint (many (count + 1) (fun _ -> leaf (range 0 count) (fun _ -> metres 1000.)))

let problems =
  [
    ("1000 x 1000, all at one place", 1000, fun () -> alike 1000 (fun _ -> 500.));
    ("1000 x 1000, all costs 0", 1000, fun () -> alike 1000 (fun _ -> 0.));
    ("1000 x 1000, random places in 10 km", 1000, fun () -> places 1000 10_000.);
    ("1000 x 1000, random places in 30 mm", 1000, fun () -> places 1000 0.03);
    ("1000 x 1000, random costs", 1000, fun () -> random_costs 1000);
    ("1000 x 1000, ten harbours", 1000, fun () -> harbours 1000);
    ("1000 x 1000, products", 1000, fun () -> products 1000);
    ("1001 x 1000, one too many", 1000, fun () -> too_few 1000);
    ("50 boats | 50 flights of one aircraft", 70, boats_and_aircraft);
    ("20 branches of two types", 40, fun () -> two_types 20);
    ("8 branches of two payloads", 20, fun () -> two_payloads 8 (fun _ -> metres 1000.));
    ("20 branches of two payloads, costs 0", 50, fun () -> two_payloads 20 (fun _ -> 0.));
    ("20 branches of two payloads", 50, fun () -> two_payloads 20 (fun _ -> metres 1000.));
    ("400 branches of two payloads, costs 0", 1000, fun () -> two_payloads 400 (fun _ -> 0.));
    ("400 branches of two payloads", 1000, fun () -> two_payloads 400 (fun _ -> metres 1000.));
    ("2 stages of 10 x 10, random costs", 10, fun () -> stages 2 10 10 (fun _ -> metres 1000.));
    ("3 stages of 5 x 10, random costs", 10, fun () -> stages 3 5 10 (fun _ -> metres 1000.));
    ("3 stages of 20 x 40, costs 0", 40, fun () -> stages 3 20 40 (fun _ -> 0.));
    ("3 stages of 20 x 40, random costs", 40, fun () -> stages 3 20 40 (fun _ -> metres 1000.));
    ("chain of 10000 >>", 10, fun () -> chain 10_000);
  ]

let () =
  let run (name, vehicles, make) =
    let tree = make () in
    let start = Sys.time () in
    let result = solve_within ~effort ~vehicles tree in
    let elapsed = Sys.time () -. start in
    let pp_result ppf = function
      | Ok { proven = true; _ } -> Fmt.string ppf "best"
      | Ok { proven = false; _ } -> Fmt.string ppf "feasible"
      | Error (No_candidate _) -> Fmt.string ppf "no candidate"
      | Error (Conflict { leaves; _ }) -> Fmt.pf ppf "conflict of %d leaves" (List.length leaves)
    in
    Fmt.pr "%-40s %8.3f s  %a@." name elapsed pp_result result
  in
  List.iter run problems
