open Dolphin_semantics
open Core

let is_computation : operation -> bool = function
  | Unary _ | Binary _ | Make_list | Make_map _ | Make_range _ | Concatenate | Element | Property _ | Add_setting _
  | Build ((Pos | Imc_plan | Mission), _)
  | Builtin (Location_of | Area_of | Math _ | Geometry _ | Time_of_day) -> true
  | Replace_element | Replace_member _ | Call _ | Method _
  | Build ((Pick | All_of | One_of | Recruit), _) | Pick_if_any
  | Builtin _ | Make_branch | Make_recruit -> false

(* Locals that [e] itself has set before count as its own. *)
let is_closed e =
  let own = Hashtbl.create 4 in
  let rec closed (e : expression) =
    match e.node with
    | Constant _ -> true
    | Local slot -> Hashtbl.mem own slot
    | Set_local (slot, e) ->
      let is_closed = closed e in
      Hashtbl.replace own slot ();
      is_closed
    | Apply (Builtin Time_of_day, []) -> false
    | Apply (operation, arguments) -> is_computation operation && List.for_all closed arguments
    | Block parts -> List.for_all closed parts
    | Global _ | Set_global _ | Make_closure _ | If _ | While _ | For _ | Return _ | Break | Continue -> false
  in
  closed e

let rec slots (e : expression) =
  let of_all = List.fold_left (fun most e -> max most (slots e)) 0 in
  match e.node with
  | Local slot -> slot + 1
  | Set_local (slot, e) -> max (slot + 1) (slots e)
  | Apply (_, es) | Block es -> of_all es
  | Constant _ | Global _ | Set_global _ | Make_closure _ | If _ | While _ | For _ | Return _ | Break | Continue -> 0

let fuel = 100_000

let value program world e =
  let lambda =
    { id = -1; label = "constant"; parameters = 0; implicit = false; captures = [||]; slots = slots e; code = e;
      lambda_site = e.site }
  in
  let context : Code.context =
    { program; world; allocation = Vehicle_map.empty; bound = []; held = lazy []; needed = lazy [];
      store = Store.empty; tuples = Tuples.empty Tuple_space.no_key; mode = Task_code; deeds = [] }
  in
  match Machine.run ~fuel context (Machine.call { lambda; captured = [||] } []) with
  | Decided (Finished x, _, _) -> Ok x
  | Decided (Faulted fault, _, _) | Unclear fault -> Error fault
  | Decided ((Exhausted | Did _ | Waits _ | Halted _ | Left_off), _, _) | Open _ ->
    Error (Fault.make e.site "this has no value")
