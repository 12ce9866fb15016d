type 'a tree = 'a Cotree.tree = Leaf of 'a | Disjoint of 'a tree list | Shared of 'a tree list

type leaf = { vehicles : int array; metres : (int -> float) option }

let listed candidates =
  let vehicles = Array.of_list (List.sort_uniq Int.compare (List.map fst candidates)) in
  let least = Hashtbl.create (Array.length vehicles) in
  let add (vehicle, metres) =
    match Hashtbl.find_opt least vehicle with
    | Some metres' when Float.compare metres' metres <= 0 -> ()
    | Some _ | None -> Hashtbl.replace least vehicle metres
  in
  List.iter add candidates;
  { vehicles; metres = Some (Hashtbl.find least) }

type failure = No_candidate of int | Conflict of { leaves : int list; vehicles : int list }

type solution = { vehicles : int array; proven : bool }

let effort = 200_000_000

let pp_failure ppf = function
  | No_candidate leaf -> Format.fprintf ppf "leaf %d has no candidate" leaf
  | Conflict { leaves; vehicles } ->
    let comma ppf () = Format.pp_print_string ppf ", " in
    let numbers = Format.(pp_print_list ~pp_sep:comma pp_print_int) in
    Format.fprintf ppf "leaves %a cannot all be served by vehicles %a" numbers leaves numbers vehicles

(* Neighbours that are one leaf, as the parts of a long [>>] may be, share what is made of it. *)
let candidates_of ~vehicles leaves =
  let latest = ref None in
  let of_leaf (leaf : leaf) =
    match !latest with
    | Some (given, made) when leaf == given -> made
    | Some _ | None ->
      let made = Part.candidates ~vehicles leaf.vehicles leaf.metres in
      latest := Some (leaf, made);
      made
  in
  Array.map of_leaf leaves

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
  let conflict leaves =
    let vehicles = Array.to_list (Part.vehicles_of candidates (Array.of_list leaves)) in
    Error (Conflict { leaves; vehicles })
  in
  (* [effort] is shared out evenly among the parts that are yet to come. *)
  let rec solve_parts parts ~effort ~proven =
    match parts with
    | [] -> Ok { vehicles = result; proven }
    | leaves :: others -> (
        match One_vehicle.solve ~restricted ~spent candidates leaves with
        | Ok (Some found) ->
          List.iter (fun (leaf, vehicle) -> result.(leaf) <- vehicle) found;
          solve_parts others ~effort ~proven
        | Error leaves -> conflict leaves
        | Ok None -> (
            let before = !spent in
            let budget = effort / List.length parts in
            let part = Part.make ~restricted candidates leaves in
            match Branch_and_bound.solve ~restricted ~spent ~budget candidates part with
            | Error leaves -> conflict leaves
            | Ok (allocation, is_best) ->
              install part allocation;
              solve_parts others ~effort:(max 0 (effort - (!spent - before))) ~proven:(proven && is_best)))
  in
  let rec first_without leaf =
    if leaf = Array.length candidates then None
    else if candidates.(leaf).vehicles = [||] then Some leaf
    else first_without (leaf + 1)
  in
  match first_without 0 with
  | Some leaf -> Error (No_candidate leaf)
  | None ->
    let is_left leaves =
      match Alike.solve ~restricted candidates leaves with
      | Some found -> Array.iteri (fun row leaf -> result.(leaf) <- found.(row)) leaves; false
      | None -> true
    in
    solve_parts (List.filter is_left (Part.components ~vehicles candidates)) ~effort ~proven:true

let solve ~vehicles tree =
  Result.map (fun { vehicles; _ } -> vehicles) (solve_within ~effort ~vehicles tree)
