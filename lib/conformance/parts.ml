open Dolphin_semantics
open Data

exception Too_large = Data.Too_large

type 'a t = { write : 'a -> string; read : string -> ('a, string) result }

(* [0.] and [-0.] are equal. *)
let rec with_one_zero : json -> json = function
  | `Float 0. -> `Float 0.
  | `List items -> `List (List.map with_one_zero items)
  | json -> json

let part to_json of_json =
  let write x = Dolphin_json.Canonical.to_string (with_one_zero (to_json (budget ()) x)) in
  let read text =
    match of_json (Yojson.Safe.from_string text) with
    | x -> Ok x
    | exception Wrong why -> Error why
    | exception Yojson.Json_error _ -> Error "it is not JSON"
  in
  { write; read }

let machine nodes = part Control_data.of_machine (Control_data.machine nodes)
let residual nodes = part Control_data.of_residual (Control_data.residual nodes)

let shared nodes p =
  let of_json json = Snapshot.shared nodes p (list Fun.id json) in
  part (fun budget shared -> `List (Snapshot.of_shared budget shared)) of_json

let configuration nodes p =
  let unnamed (c : Configuration.t) =
    match c.control with
    | Ended (Failed fault) -> { c with control = Ended (Failed (Fault.make fault.site fault.message)) }
    | Ended (Completed | Halted _ | Interrupted) | Script _ | Waiting _ | Executing _ -> c
  in
  part (fun budget c -> Snapshot.of_state budget (unnamed c)) (Snapshot.state nodes p)
