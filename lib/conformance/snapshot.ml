open Dolphin_semantics
open Data
module Request = Dolphin_trace.Request

let of_text x : json = `String x

(* {1 In the clear} *)

let ending (c : Configuration.t) : json =
  match c.control with
  | Ended e -> `Assoc (Request.ending_members (Request.ending e))
  | Script _ | Waiting _ | Executing _ -> `Null

let control (c : Configuration.t) =
  match c.control with Script _ -> "script" | Waiting _ -> "wait" | Executing _ -> "exec" | Ended _ -> "end"

let pairs (c : Configuration.t) =
  let of_key (k, xs) = List.map (fun x -> Format.asprintf "%a" Value.pp_tuple (k, x)) xs in
  List.concat_map of_key (Tuples.bindings c.shared.tuples)

let variables (p : Core.program) (c : Configuration.t) =
  let variable (i, x) = (p.global_names.(i), of_text (Format.asprintf "%a" Value.pp x)) in
  List.map variable (Store.bindings c.shared.store)

(* {1 The whole} *)

let of_shared budget (s : Shared.t) : json list =
  let each = Value_data.of_value budget in
  [ of_list (of_pair (fun i -> `Int i) each) (Store.bindings s.store);
    of_list (of_pair of_text (Value_data.of_platform_task budget)) (Vehicle_map.bindings s.allocation);
    of_list of_text s.bound;
    of_list (of_pair of_text (of_list each)) (Tuples.bindings s.tuples) ]

let of_state budget (c : Configuration.t) : json =
  let control = Control_data.of_control budget c.control in
  `List (control :: of_shared budget c.shared)

let to_json p (c : Configuration.t) =
  match of_state (budget ()) c with
  | exception Too_large -> Error "the configuration is too large to be written down"
  | state ->
    let task (v, (p : Core.platform_task)) = (v, of_text p.name) in
    let tasks = List.map task (Vehicle_map.bindings c.shared.allocation) in
    Ok
      (`Assoc
         [ ("control", `String (control c)); ("end", ending c); ("A", `Assoc tasks);
           ("B", of_list of_text c.shared.bound);
           ("N", of_list of_text (pairs c)); ("store", `Assoc (variables p c)); ("state", state) ])

let post tuples (k, xs) = List.fold_left (fun tuples x -> Tuples.post k x tuples) tuples xs

let shared nodes (p : Core.program) : json list -> Shared.t = function
  | [ store; allocation; bound; tuples ] ->
    let variable json =
      let i, x = pair whole (Value_data.value nodes) json in
      if i < 0 || i >= Array.length p.global_names then wrong "the number of a variable" json else (i, x)
    in
    let add store (i, x) = Store.set i x store in
    let run map (v, p) = Vehicle_map.add v p map in
    let none = Tuples.empty p.ordered_keys in
    { store = List.fold_left add Store.empty (list variable store);
      allocation =
        List.fold_left run Vehicle_map.empty (list (pair text (Value_data.platform_task nodes)) allocation);
      bound = list text bound;
      tuples = List.fold_left post none (list (pair text (list (Value_data.value nodes))) tuples) }
  | parts -> wrong "what configurations share" (`List parts)

let state nodes p : json -> Configuration.t = function
  | `List (control :: parts) ->
    let control = Control_data.control nodes control in
    { control; shared = shared nodes p parts }
  | json -> wrong "the state of a configuration" json

let of_json nodes p : json -> _ = function
  | `Assoc members -> (
      match List.assoc_opt "state" members with
      | None -> Error "\"state\" is missing"
      | Some json -> (
          match state nodes p json with
          | exception Wrong why -> Error why
          | c -> Result.map (fun () -> c) (Configuration.invariant c)))
  | _ -> Error "a configuration is an object"
