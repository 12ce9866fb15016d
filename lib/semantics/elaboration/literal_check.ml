open Dolphin_plans
open Core
module Ast = Dolphin_syntax.Ast

let rec value (e : Ast.expression) =
  match e.it with
  | Null -> Some Null
  | Boolean b -> Some (Boolean b)
  | Integer n -> Some (Integer n)
  | Number n -> Some (Number n)
  | String s -> Some (String s)
  | Unary (op, e) -> Option.bind (value e) (fun x -> Result.to_option (Operators.unary op x))
  | Member { subject; name; safe = false } ->
    Option.bind (value subject) (fun x -> Result.to_option (Operators.in_unit x name.it))
  | _ -> None

let all es =
  let values = List.filter_map value es in
  if List.compare_lengths values es = 0 then Some values else None

(* The values of literals do not depend on the program. *)
let context : Code.context =
  let code = { node = Constant Null; site = 0 } in
  let main =
    { id = 0; label = ""; parameters = 0; implicit = false; captures = [||]; slots = 0; code; lambda_site = 0 }
  in
  let program =
    { source_name = ""; locations = [||]; global_names = [||]; functions = []; main; ordered_keys = Tuple_space.no_key;
      inputs = []; vehicle_inputs = [];
      on_interrupt = None; recruits = false; goes_round = false; reads_sensors = false; reads_now = false;
      reads_time_of_day = false; asks_running = false; fences = Fences.none; place = None; begins = None }
  in
  let tuples = Tuples.empty Tuple_space.no_key in
  { program; world = World.empty; allocation = Vehicle_map.empty; bound = []; held = lazy []; needed = lazy [];
    store = Store.empty; tuples; mode = Script; deeds = [] }

let fault operation values =
  match operation with
  | Time_of_day when values = [] -> None
  | Platform_task | Make_idle | Pause | Location_of | Math _ | Time_of_day -> (
      match Procedures.apply context 0 operation values with Wrong message -> Some message | _ -> None)
  | _ -> None

let fault_of_time what e =
  match Option.bind (value e) Value.to_number with
  | Some seconds when not (Time.is_one seconds) -> Some (Time.none what seconds)
  | Some _ | None -> None

let fault_of_rounds e =
  match value e with
  | Some n when Value.to_number n <> None -> Result.fold ~ok:(fun _ -> None) ~error:Option.some (Procedures.rounds n)
  | Some _ | None -> None

let fault_of_mission setting arguments =
  Mission_builder.literal_fault setting (List.map (fun (name, e) -> (name, value e)) arguments)

let fault_of_pick setting positional =
  match Settings.pick [ { setting; positional; named = []; setting_site = 0 } ] with
  | Ok _ -> None
  | Error (fault : Fault.t) -> Some fault.message
