open Core
open Code

let of_result = function Ok x -> Value x | Error message -> Wrong message

let expected what x = of_result (Operators.expected what x)

let on_cut at : Dolphin_syntax.Ast.on_cut -> on_cut = function Completes -> Completes at | Fails -> Fails at

let rounds x =
  match Value.canonical_number x with
  | Integer n when n >= 1 -> Ok n
  | x when Value.to_number x = None -> Operators.expected "how many rounds there are, as in repeat 3, T" x
  | x -> Error (Printf.sprintf "repeat takes a whole number of rounds, 1 or more, not %s" (Value.to_string x))

let spins = "a round of this repeat never waits: it would loop endlessly, and nothing else would happen"

(* Whether a task is done without any wait. *)
let rec never_waits = function
  | Action _ -> true
  | Sequence (a, b) | Parallel (a, b) -> never_waits a && never_waits b
  | Allocated (a, _) | Until (_, _, a) | During (_, Seconds _, a) | Watch (a, _) | Repeat { body = a; _ }
  | Ensure (_, a) -> never_waits a
  | Platform _ | Condition _ | All_of _ | One_of _ | Idle _ | Confirm _ | During (_, Given_by _, _) | Made _
  | Recruit _ | Fresh _ -> false

let repeat at n body until =
  let made rounds =
    if rounds = None && until = None && never_waits body then Wrong spins
    else if rounds = Some 1 then Value (Task body)
    else Value (Task (Repeat { rounds; until; body; site = at }))
  in
  match Option.map rounds n with
  | None -> made None
  | Some (Ok n) -> made (Some n)
  | Some (Error message) -> Wrong message

(* Code in the place of a task is the task that it makes. *)
let as_task operation i x =
  match operation, i, x with
  | (Make_watch | Make_ensure _), 0, Closure c
  | (Make_wait_for | Make_until _ | Make_during _), 1, Closure c -> Task (Made c)
  | Make_repeat { counted; _ }, _, Closure c when i = if counted then 1 else 0 -> Task (Made c)
  | _, _, x -> x

(* [T ensure { }] is T; of two around one another, the inner one comes first. *)
let ensure ds t =
  match ds, t with
  | [], t -> t
  | ds, Ensure (first, t) -> Ensure (first @ ds, t)
  | ds, t -> Ensure (ds, t)

let rec ensured forms arguments =
  let pair k x forms arguments =
    match x with
    | Wildcard -> Error (Error "only consume and poll take the wildcard _")
    | x -> Result.map (fun ds -> Pair (k, Value.canonical x) :: ds) (ensured forms arguments)
  in
  match forms, arguments with
  | Pair_of (Some k) :: forms, x :: arguments -> pair k x forms arguments
  | Pair_of None :: forms, String k :: x :: arguments -> pair k x forms arguments
  | Pair_of None :: forms, ((Integer _ | Number _) as k) :: x :: arguments ->
    pair (Value.to_string (Value.canonical_number k)) x forms arguments
  | Pair_of None :: _, k :: _ -> Error (Operators.expected "a string as a key" k)
  | Variable_of (i, name) :: forms, x :: arguments ->
    Result.map (fun ds -> Variable (i, name, x) :: ds) (ensured forms arguments)
  | Taken_pairs :: forms, arguments -> Result.map (fun ds -> Taken :: ds) (ensured forms arguments)
  | _, _ -> Ok []

let make_task context at = function
  | Make_repeat { counted = false; asked = false }, [ Task t ] -> repeat at None t None
  | Make_repeat { counted = true; asked = false }, [ n; Task t ] -> repeat at (Some n) t None
  | Make_repeat { counted = false; asked = true }, [ Task t; Closure c ] -> repeat at None t (Some c)
  | Make_repeat { counted = true; asked = true }, [ n; Task t; Closure c ] -> repeat at (Some n) t (Some c)
  | Make_repeat { counted = true; _ }, (_ :: x :: _) | Make_repeat { counted = false; _ }, (x :: _) ->
    expected "a task to repeat" x
  | Platform_task, [ String "" ] -> Wrong "a plan's name may not be empty"
  | Platform_task, [ x ] -> expected "the name of a plan, a string" x
  | Make_action, [ Closure c ] -> Value (Task (Action c))
  | Make_condition, [ Closure c ] -> Value (Task (Condition c))
  | (Make_action | Make_condition), [ x ] -> expected "code { ... }" x
  | Make_wait_for, [ Closure guard; Task body ] -> Value (Task (One_of [ { guard; body } ]))
  | Make_until e, [ Closure c; Task t ] -> Value (Task (Until (on_cut at e, c, t)))
  | (Make_wait_for | Make_until _), ([ Closure _; x ] | [ x; _ ]) -> expected "a task" x
  | Make_watch, [ Task t; Closure c ] -> Value (Task (Watch (t, c)))
  | Make_watch, (x :: _) -> expected "a task after watch" x
  | Make_fresh, [ Closure c ] -> Value (Task (Fresh c))
  | Make_fresh, [ x ] -> expected "code { k -> T }" x
  | Make_ensure forms, Task t :: arguments -> (
      match ensured forms arguments with
      | Ok ds -> Value (Task (ensure ds t))
      | Error e -> of_result e)
  | Make_ensure _, x :: _ -> expected "a task before ensure" x
  | Make_idle, [ Vehicles vs ] ->
    let is_idle v = List.mem v context.bound && not (List.mem v (Lazy.force context.held)) in
    Value (Vehicles (List.filter is_idle vs))
  | Make_idle, [ x ] -> (
      match Value.to_number x with
      | Some seconds when Time.is_one seconds -> Value (Task (Idle { seconds; site = at }))
      | Some seconds -> Wrong (Time.none "idle" seconds)
      | None -> expected "a time after idle, as in idle(10.seconds)" x)
  | Make_confirm, [ x ] -> Value (Task (Confirm { prompt = Value.to_string x; site = at }))
  | Make_during e, [ Closure c; Task t ] -> Value (Task (During (on_cut at e, Given_by c, t)))
  | Make_during e, [ x; Task t ] -> (
      let e = on_cut at e in
      let during = Value.during e in
      match Value.to_number x with
      | Some seconds when Time.is_one seconds -> Value (Task (During (e, Seconds seconds, t)))
      | Some seconds -> Wrong (Time.none during seconds)
      | None -> expected (Printf.sprintf "a time after %s, as in %s 10.minutes run T" during during) x)
  | Make_during _, [ _; x ] -> expected "a task" x
  | _, _ -> Wrong "this construct has the wrong number of parts"

let rec allocate_each names arguments tasks =
  match names, arguments with
  | "_" :: names, Closure c :: arguments -> allocate_each names arguments (Made c :: tasks)
  | _ :: names, Vehicles vs :: Closure c :: arguments ->
    allocate_each names arguments (Allocated (Made c, vs) :: tasks)
  | "_" :: names, Task t :: arguments -> allocate_each names arguments (t :: tasks)
  | _ :: names, Vehicles vs :: Task t :: arguments -> allocate_each names arguments (Allocated (t, vs) :: tasks)
  | "_" :: _, x :: _ -> Error (Operators.expected "a task after _:" x)
  | name :: _, Vehicles _ :: x :: _ -> Error (Operators.expected (Printf.sprintf "a task after %s:" name) x)
  | name :: _, x :: _ ->
    Error (Operators.expected (Printf.sprintf "'%s' to name a vehicle set" name) x)
  | _, [] -> (
      match tasks with
      | [] -> Error (Error "nothing to execute")
      | last :: before -> Ok (List.fold_left (fun all t -> Parallel (t, all)) last before))
  | [], _ :: _ -> Error (Error "more tasks than names")

let blocking context name request =
  match context.mode with
  | Script -> Wait request
  | Task_code | Handler _ ->
    Wrong (Printf.sprintf "%s belongs to the script: code inside of a task cannot wait" name)

(* The pairs of an operation, or the argument that is not a key. *)
let rec given_pairs keys arguments =
  let pair k x keys arguments = Result.map (fun rest -> (k, x) :: rest) (given_pairs keys arguments) in
  match keys, arguments with
  | Some k :: keys, x :: arguments -> pair k x keys arguments
  | None :: keys, k :: x :: arguments -> (
      match k with
      | String k -> pair k x keys arguments
      | Integer _ | Number _ -> pair (Value.to_string (Value.canonical_number k)) x keys arguments
      | k -> Error k)
  | _, _ -> Ok []

let with_pairs keys arguments f =
  match given_pairs keys arguments with
  | Ok pairs -> f (List.map (fun (k, x) -> (k, Value.canonical x)) pairs)
  | Error k -> expected "a string as a key" k

(* Code as a value of [consume] and [poll]: elaboration has seen to that which is written there. *)
let with_wanted keys arguments f =
  let is_code = function _, Closure _ -> true | _, _ -> false in
  with_pairs keys arguments (fun pairs ->
      match List.find_opt is_code pairs with
      | Some (k, _) -> Wrong (Printf.sprintf "a pattern is written behind its key, as in consume %s: { x -> ... }" k)
      | None -> f pairs)

let post context pairs =
  if List.exists (function _, Wildcard -> true | _, _ -> false) pairs then
    Wrong "only consume and poll take the wildcard _"
  else
    let tuples = List.fold_left (fun n (k, x) -> Tuples.post k x n) context.tuples pairs in
    Done (Posted pairs, { context with tuples }, Null)

let consume context pairs =
  let take taken (k, x) =
    match taken with
    | None -> None
    | Some (tuples, taken) -> (
        match x with
        | Wildcard ->
          Option.map (fun (x, tuples) -> (tuples, (k, x) :: taken)) (Tuples.consume_oldest k tuples)
        | x -> Option.map (fun tuples -> (tuples, (k, x) :: taken)) (Tuples.consume k x tuples))
  in
  match List.fold_left take (Some (context.tuples, [])) pairs with
  | None -> Value (Boolean false)
  | Some (tuples, taken) -> Done (Consumed (List.rev taken), { context with tuples }, Boolean true)

let poll context pairs =
  let there (k, x) =
    match x with
    | Wildcard -> Tuples.poll_any k context.tuples
    | x -> Tuples.poll k x context.tuples
  in
  Value (Boolean (List.for_all there pairs))

let values_of context pairs =
  List (Vector.of_list (List.concat_map (fun (k, _) -> Tuples.values k context.tuples) pairs))

(* The result of [look] for the only vehicle of [vs], if it has several possible values. *)
let looked context vs look =
  match Methods.one_vehicle context.world vs with
  | Error message -> Wrong message
  | Ok state ->
    let rec ask world = match look world state with Ok x -> Value x | Error question -> Asks (question, ask) in
    ask context.world

let sense context subject vs = looked context vs (fun world -> Reading.look world subject)

let rest context p vs =
  of_result (Result.bind (Methods.one_vehicle context.world vs) (Rest.of_vehicle context.world p))

let travel context (p : platform_task) quantity vs =
  match looked context vs (fun world -> Travel.of_plan world p quantity) with
  | Value (Number n) when n = infinity ->
    Wrong (Printf.sprintf "plan '%s' goes on until it is stopped: its length is unknown" p.name)
  | outcome -> outcome

let minimum_connection_timeout = 5.
let maximum_connection_timeout = 3600.

let set_connection_timeout context vehicles x =
  match Value.to_number x with
  | None -> expected "a time, as in 2.min" x
  | Some seconds when minimum_connection_timeout <= seconds && seconds <= maximum_connection_timeout ->
    Done (Set_connection_timeout (vehicles, seconds), context, Null)
  | Some seconds ->
    Wrong (Printf.sprintf "a connection timeout is from 5 seconds to 1 hour, not %g seconds" seconds)

let numbers arguments =
  let numbers = List.filter_map Value.to_number arguments in
  if List.compare_lengths numbers arguments = 0 then Some numbers else None

let is_a form x =
  match form, x with
  | A_number, (Integer _ | Number _ | Reading { quantity = Amount; _ })
  | A_string, (String _ | Reading { quantity = Words; _ })
  | A_list, (List _ | Range _)
  | A_map, Map _ -> true
  | (A_number | A_string | A_list | A_map), _ -> false

let mathematics name arguments =
  let whole f = if Float.abs f < 0x1p62 then Value (Integer (int_of_float f)) else Value (Number f) in
  let result f =
    if Float.is_nan f then Wrong (Printf.sprintf "Math.%s has no result there" name) else Value (Number f)
  in
  match name, arguments, numbers arguments with
  | "abs", [ Integer i ], _ when i <> min_int -> Value (Integer (abs i))
  | "max", [ x; y ], Some [ a; b ] -> Value (if a >= b then x else y)
  | "min", [ x; y ], Some [ a; b ] -> Value (if a <= b then x else y)
  | "round", _, Some [ a ] -> whole (Float.floor (a +. 0.5))
  | _, _, Some [ a ] -> (
      match name with
      | "abs" -> result (Float.abs a)
      | "floor" -> result (Float.floor a)
      | "ceil" -> result (Float.ceil a)
      | "sqrt" -> result (Float.sqrt a)
      | "exp" -> result (Float.exp a)
      | "log" -> result (Float.log a)
      | "log10" -> result (Float.log10 a)
      | "sin" -> result (Float.sin a)
      | "cos" -> result (Float.cos a)
      | "tan" -> result (Float.tan a)
      | "asin" -> result (Float.asin a)
      | "acos" -> result (Float.acos a)
      | "atan" -> result (Float.atan a)
      | "toRadians" -> result (Dolphin_geo.Angle.radians a)
      | "toDegrees" -> result (Dolphin_geo.Angle.degrees a)
      | "signum" -> result (if a > 0. then 1. else if a < 0. then -1. else 0.)
      | _ -> Wrong (Printf.sprintf "Math.%s does not take one number" name))
  | _, _, Some [ a; b ] -> (
      match name with
      | "pow" -> result (Float.pow a b)
      | "atan2" -> result (Float.atan2 a b)
      | "hypot" -> result (Float.hypot a b)
      | _ -> Wrong (Printf.sprintf "Math.%s does not take two numbers" name))
  | _, _, _ -> Wrong (Printf.sprintf "Math.%s takes numbers" name)

let settle context verdict =
  match context.mode with
  | Handler _ -> Judged verdict
  | Script | Task_code -> Wrong "ignore(), propagate() and retry() belong in onError { ... }"

let release context vs =
  let bound = Vehicle_set.of_list context.bound in
  match List.filter (fun v -> Vehicle_set.mem v bound) vs with
  | [] -> Value Null
  | vs ->
    let released = Vehicle_set.of_list vs in
    let bound = List.filter (fun v -> not (Vehicle_set.mem v released)) context.bound in
    Done (Released vs, { context with bound }, Null)

(* Tasks beside or after the [watch] of the handler may not need them. *)
let dismiss context vs =
  match context.mode with
  | Script | Task_code -> Wrong "dismiss belongs in onError { ... }"
  | Handler _ -> (
      let is_needed v = List.mem v context.bound && List.mem v (Lazy.force context.needed) in
      match List.filter is_needed vs with
      | [] -> release context vs
      | v :: _ -> Wrong (Printf.sprintf "%s cannot be dismissed: a task beside or after this watch is to run on it" v))

let apply context at operation arguments =
  match operation, arguments with
  | Platform_task, [ String name ] when name <> "" ->
    Value (Task (Platform { name; plan = None; task_site = at }))
  | ( ( Platform_task | Make_action | Make_condition | Make_wait_for | Make_until _ | Make_idle | Make_confirm
      | Make_during _ | Make_watch | Make_fresh | Make_ensure _ | Make_repeat _ ),
      _ ) -> make_task context at (operation, List.mapi (as_task operation) arguments)
  | Execute, [ Closure c ] -> blocking context "execute" (Execute (Made c))
  | Execute, [ Task t ] -> blocking context "execute" (Execute t)
  | Execute, [ x ] -> expected "a task to execute" x
  | Execute_for names, arguments -> (
      match allocate_each names arguments [] with
      | Ok t -> blocking context "execute" (Execute t)
      | Error e -> of_result e)
  | Release, [ Vehicles vs ] -> (
      match context.mode with
      | Script -> release context vs
      | Task_code | Handler _ -> Wrong "release belongs to the script, not to code inside of a task")
  | Release, [ x ] -> expected "a vehicle set to release" x
  | Dismiss, [ Vehicles vs ] -> dismiss context vs
  | Dismiss, [ x ] -> expected "a vehicle set to dismiss" x
  | Set_connection_timeout, [ x ] -> set_connection_timeout context None x
  | Set_connection_timeout, [ Vehicles vs; x ] -> set_connection_timeout context (Some vs) x
  | Set_connection_timeout, [ x; _ ] -> expected "a vehicle set" x
  | Ask, [ prompt ] -> blocking context "ask" (Ask (Value.to_string prompt))
  | Message, [ x ] -> Done (Said (Value.to_string x), context, Null)
  | Pause, [ x ] -> (
      match Value.to_number x with
      | Some seconds when Time.is_one seconds -> blocking context "pause" (Pause seconds)
      | Some seconds -> Wrong (Time.none "pause" seconds)
      | None -> expected "a time after pause, as in pause 12.seconds" x)
  | Halt, [] -> Stop ""
  | Halt, [ x ] -> Stop (Value.to_string x)
  | Interrupted, [ _ ] -> Leave_off
  | Post [], [ Map entries ] -> post context (List.map (fun (k, x) -> (k, Value.canonical x)) entries)
  | Post [], [ x ] -> expected "pairs, as in post ready: 1, or a map" x
  | Post keys, arguments -> with_pairs keys arguments (post context)
  | Consume keys, arguments -> with_wanted keys arguments (consume context)
  | Values_of, [ x ] -> with_pairs [ None ] [ x; Null ] (fun pairs -> Value (values_of context pairs))
  | Poll [], [ String k ] -> poll context [ (k, Wildcard) ]
  | Poll [], [ x ] -> expected "a key, as in poll 'ready', or pairs, as in poll(ready: 1)" x
  | Poll keys, arguments -> with_wanted keys arguments (poll context)
  | Position_of, [ Vehicles vs ] -> sense context Position vs
  | Sensor_of sensor, [ Vehicles vs ] -> sense context (Sensor sensor) vs
  | Reading_of, [ Vehicles vs; String name ] -> sense context (Sensor (Measurement name)) vs
  | Reading_of, [ Vehicles _; x ] -> expected "the name of a measurement, as in reading(v, 'Temperature')" x
  | Now, [] -> Value (Reading.now context.world)
  | Time_of_day, [] -> (
      match Reading.time_of_day ~begins:context.program.begins context.world with
      | Some time -> Value time
      | None -> Wrong "the time of day is not known, because the date at which the run begins is not given")
  | Time_of_day, [ String text ] -> of_result (Result.map (fun n -> Integer n) (Calendar.time_of_day text))
  | Time_of_day, [ x ] -> expected "a time of day, as in timeOfDay '21:30'" x
  | Is_running, [ Vehicles vs ] ->
    let is_running (v : World.vehicle_state) = Boolean (Vehicle_map.mem v.id context.allocation) in
    of_result (Result.map is_running (Methods.one_vehicle context.world vs))
  | (Position_of | Sensor_of _ | Is_running), [ x ] | Reading_of, [ x; _ ] -> expected "a vehicle" x
  | Eta, [ Vehicles vs; Position p ] -> looked context vs (fun world s -> Travel.eta world s p)
  | Eta, [ Vehicles _; x ] -> expected "a position" x
  | Eta, [ x; _ ] -> expected "a vehicle" x
  | Location_of, [ String text ] -> (
      match Dolphin_geo.Coordinates.of_string text with Ok p -> Value (Position p) | Error why -> Wrong why)
  | Location_of, [ x ] -> expected "a latitude and a longitude, or a text that gives both" x
  | Location_of, ([ _; _ ] | [ _; _; _ ]) -> (
      match numbers arguments with
      | Some (latitude :: longitude :: height) -> (
          let height = match height with h :: _ -> h | [] -> 0. in
          match Dolphin_geo.Position.make ~latitude ~longitude ~height with
          | Ok p -> Value (Position p)
          | Error e -> Wrong (Format.asprintf "%a" Dolphin_geo.Position.pp_error e))
      | Some [] | Some [ _ ] | None -> Wrong "location takes latitude and longitude in degrees, and a height in metres")
  | Area_of, [ centre; radius ] -> of_result (Operators.binary Around centre radius)
  | Assert, [] -> Refuted "assertion failed"
  | Assert, [ x ] -> Refuted ("assertion failed: " ^ Value.to_string x)
  | Fail, [ x ] -> Wrong (Value.to_string x)
  | Ignore, [] -> settle context Ignored
  | Propagate, [] -> settle context Propagated
  | Retry, [] -> settle context Retried
  | Get_supplier, [] ->
    blocking context "getSupplier" (Host_call { subject = None; member = "getSupplier"; arguments = Some [] })
  | Is_there, [ x ] ->
    let is_number = match x with Integer _ | Number _ -> true | _ -> false in
    Value (Boolean (is_number || Value.truth x))
  | Is_a form, [ x ] -> Value (Boolean (is_a form x))
  | Is_host, [ x ] -> Value (Boolean (match x with Host _ -> true | _ -> false))
  | Math name, arguments -> mathematics name arguments
  | Geometry (name, keys), arguments -> of_result (Geometry.apply name keys arguments)
  | ( ( Execute | Release | Set_connection_timeout | Ask | Message | Pause | Halt | Position_of | Sensor_of _
      | Is_running | Reading_of | Now | Time_of_day | Eta | Location_of | Area_of | Assert | Fail | Ignore | Propagate
      | Retry | Dismiss | Get_supplier | Interrupted | Is_a _ | Is_host | Is_there | Values_of ),
      _ ) -> Wrong (Printf.sprintf "wrong number of arguments, %d" (List.length arguments))
