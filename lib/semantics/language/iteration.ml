open Dolphin_results
open Core
open Code

let by_name name arguments =
  match name, arguments with
  | "each", [ Closure c ] | "eachWithIndex", [ Closure c ] | "times", [ Closure c ] -> Some (Each, c, [])
  | ("collect" | "collectWithIndex"), [ Closure c ] -> Some (Collect, c, [])
  | ("findAll" | "filter"), [ Closure c ] -> Some (Find_all, c, [])
  | "find", [ Closure c ] -> Some (Find, c, [])
  | "any", [ Closure c ] -> Some (Any, c, [])
  | "every", [ Closure c ] -> Some (Every, c, [])
  | "count", [ Closure c ] -> Some (Count, c, [])
  | "sum", [ Closure c ] -> Some (Sum, c, [])
  | "sort", [ Closure c ] -> Some (Sort, c, [])
  | "max", [ Closure c ] -> Some (Greatest, c, [])
  | "min", [ Closure c ] -> Some (Least, c, [])
  | "inject", [ initial; Closure c ] -> Some (Inject, c, [ initial ])
  | _, _ -> None

let items = function
  | Integer n -> Option.value (Value.items (if n > 0 then Range (0, n - 1) else List Vector.empty)) ~default:[||]
  | subject -> Option.value (Value.items subject) ~default:[||]

let find subject name arguments =
  match subject, by_name name arguments with
  | Integer n, found when name = "times" && n <= Value.most_items -> found
  | Integer _, _ -> None
  | _, None -> None
  | subject, (Some _ as found) -> if Value.items subject = None then None else found

let arguments iteration closure subject item index gathered =
  match iteration, gathered, subject, item with
  | Inject, so_far :: _, _, _ -> [ so_far; item ]
  | _, _, Map _, Map [ (_, k); (_, x) ] when closure.lambda.parameters = 2 -> [ k; x ]
  | _, _, _, _ when closure.lambda.parameters = 2 -> [ item; Integer index ]
  | _, _, _, _ -> [ item ]

let same_kind subject items =
  match subject with
  | Vehicles _ ->
    Vehicles (List.concat_map (function Vehicles vs -> vs | _ -> []) items)
  | Map _ ->
    Map (List.filter_map (function Map [ (_, String k); (_, x) ] -> Some (k, x) | _ -> None) items)
  | _ -> List (Vector.of_list items)

(* Lists may be long: [List.combine] and [List.map] would need as much of the stack. *)
let paired items results = List.rev (List.rev_map2 (fun x r -> (x, r)) (Array.to_list items) results)

let by_result items results =
  let order (_, a) (_, b) =
    match Value.to_number a, Value.to_number b with
    | Some a, Some b -> Float.compare a b
    | _, _ -> Value.compare a b
  in
  List.stable_sort order (paired items results)

let conclude iteration subject items gathered =
  let results = List.rev gathered in
  match iteration with
  | Each -> Ok subject
  | Collect -> Ok (List (Vector.of_list results))
  | Find_all ->
    let kept (x, r) = if Value.truth r then Some x else None in
    Ok (same_kind subject (List.filter_map kept (paired items results)))
  | Find -> Ok Null
  | Any -> Ok (Boolean false)
  | Every -> Ok (Boolean true)
  | Count -> Ok (Integer (List.length (List.filter Value.truth results)))
  | Sum -> Results.fold (Operators.binary Add) (Integer 0) results
  | Inject -> Ok (match gathered with x :: _ -> x | [] -> Null)
  | Sort -> Ok (same_kind subject (List.rev (List.rev_map fst (by_result items results))))
  | Greatest -> Ok (match List.rev (by_result items results) with (x, _) :: _ -> x | [] -> Null)
  | Least -> Ok (match by_result items results with (x, _) :: _ -> x | [] -> Null)

let early iteration item result =
  match iteration with
  | Find when Value.truth result -> Some item
  | Any when Value.truth result -> Some (Boolean true)
  | Every when not (Value.truth result || Unknown.is result) -> Some (Boolean false)
  | Each | Collect | Find_all | Find | Any | Every | Count | Sum | Inject | Sort | Greatest | Least -> None
