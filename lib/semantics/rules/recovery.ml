open Core

let may_retry lambda =
  let found = ref false in
  let visit e = match e.node with Apply (Builtin Retry, _) -> found := true | _ -> () in
  Code_walk.iter visit [ lambda ];
  !found

let gives_tasks = function
  | Platform_task | Make_action | Make_condition | Make_wait_for | Make_until _ | Make_idle | Make_confirm
  | Make_during _ | Make_watch | Make_fresh | Make_ensure _ | Make_repeat _ -> true
  | Execute | Execute_for _ | Release | Set_connection_timeout | Ask | Message | Pause | Halt | Post _ | Consume _
  | Poll _ | Values_of | Position_of | Sensor_of _ | Is_running | Reading_of | Now | Time_of_day | Eta
  | Location_of | Area_of | Assert | Fail | Ignore | Propagate | Retry | Dismiss | Get_supplier | Interrupted | Is_there
  | Is_a _ | Is_host | Math _ | Geometry _ -> false

(* Code that calls itself gives what its other ends do. *)
let may_give lambda =
  let seen = ref [] in
  let rec value e =
    match e.node with
    | Constant (Task _) | Local _ | Global _ -> true
    | Constant _ | Make_closure _ | While _ | For _ | Break | Continue -> false
    | Set_local (_, e) | Set_global (_, e) | Return e -> value e
    | If (_, a, b) -> value a || value b
    | Block es -> ( match List.rev es with last :: _ -> value last | [] -> false)
    | Apply (Builtin builtin, _) -> gives_tasks builtin
    | Apply ((Binary (Sequence | Parallel) | Make_recruit), _) -> true
    | Apply (Binary Divide, t :: _) -> value t
    | Apply (Call _, { node = Constant (Closure { lambda; _ }) | Make_closure (lambda, _); _ } :: _) -> of_lambda lambda
    | Apply ((Element | Property _ | Call _ | Method _ | Build _), _) -> true
    | Apply
        ( ( Unary _ | Binary _ | Make_list | Make_map _ | Make_range _ | Concatenate | Replace_element
          | Replace_member _ | Add_setting _ | Pick_if_any
          | Make_branch ),
          _ ) -> false
  and of_lambda lambda =
    if List.memq lambda !seen then false
    else begin
      seen := lambda :: !seen;
      value lambda.code || returns lambda.code
    end
  and returns e =
    match e.node with
    | Return e -> value e
    | _ -> List.exists returns (Code_walk.parts e)
  in
  of_lambda lambda

let possible lambda = may_retry lambda || may_give lambda
