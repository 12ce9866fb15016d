type 'a tree = 'a Cotree.tree = Leaf of 'a | Disjoint of 'a tree list | Shared of 'a tree list

type leaf = { candidates : (int * float) array }

type failure = No_candidate of int | Conflict of { leaves : int list; vehicles : int list }

type solution = { vehicles : int array; proven : bool }

let effort = 200_000_000

let pp_failure ppf = function
  | No_candidate leaf -> Format.fprintf ppf "leaf %d has no candidate" leaf
  | Conflict { leaves; vehicles } ->
    let comma ppf () = Format.pp_print_string ppf ", " in
    let numbers = Format.(pp_print_list ~pp_sep:comma pp_print_int) in
    Format.fprintf ppf "leaves %a cannot all be served by vehicles %a" numbers leaves numbers vehicles

(* Neighbours that share one array of candidates, as the parts of a long [>>] do, share what is made of it. *)
let candidates_of ~vehicles leaves =
  let latest = ref ([||], [||]) in
  Array.map
    (fun leaf ->
       let given, made = !latest in
       if leaf.candidates == given && given <> [||] then made
       else begin
         let made = Part.candidates ~vehicles leaf.candidates in
         latest := (leaf.candidates, made);
         made
       end)
    leaves

let solve_within ~effort ~vehicles tree =
  let cotree, leaves = Cotree.of_tree tree in
  let candidates = candidates_of ~vehicles leaves in
  let restricted = Cotree.restriction cotree in
  let spent = ref 0 in
  let result = Array.make (Array.length leaves) (-1) in
  let install (part : Part.t) allocation =
    Array.iteri
      (fun row column -> List.iter (fun leaf -> result.(leaf) <- part.columns.(column)) part.members.(row))
      allocation
  in
  let vehicles_of leaves =
    let listed = Array.make vehicles false in
    List.iter (fun leaf -> Array.iter (fun (vehicle, _) -> listed.(vehicle) <- true) candidates.(leaf)) leaves;
    List.filter (fun vehicle -> listed.(vehicle)) (List.init vehicles Fun.id)
  in
  (* [effort] is shared out evenly among the parts that are yet to come. *)
  let rec solve_parts parts ~effort ~proven =
    match parts with
    | [] -> Ok { vehicles = result; proven }
    | part :: others -> (
        let conflict leaves = Error (Conflict { leaves; vehicles = vehicles_of leaves }) in
        match One_vehicle.solve ~spent part with
        | Found allocation ->
          install part allocation;
          solve_parts others ~effort ~proven
        | Impossible (Some leaves) -> conflict leaves
        | Impossible None | Undecided -> (
            let before = !spent in
            let budget = effort / List.length parts in
            match Branch_and_bound.solve ~restricted ~spent ~budget candidates part with
            | Error leaves -> conflict leaves
            | Ok (allocation, is_best) ->
              install part allocation;
              solve_parts others ~effort:(max 0 (effort - (!spent - before))) ~proven:(proven && is_best)))
  in
  let rec first_without leaf =
    if leaf = Array.length candidates then None
    else if candidates.(leaf) = [||] then Some leaf
    else first_without (leaf + 1)
  in
  match first_without 0 with
  | Some leaf -> Error (No_candidate leaf)
  | None ->
    let part leaves =
      match Alike.solve ~restricted candidates leaves with
      | Some found -> Array.iteri (fun row leaf -> result.(leaf) <- found.(row)) leaves; None
      | None -> Some (Part.make ~restricted candidates leaves)
    in
    solve_parts (List.filter_map part (Part.components ~vehicles candidates)) ~effort ~proven:true

let solve ~vehicles tree =
  Result.map (fun { vehicles; _ } -> vehicles) (solve_within ~effort ~vehicles tree)
