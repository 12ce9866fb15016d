open Core

type outcome =
  | Gives of value * Shared.t * Code.deed list
  | Faulty of Fault.t * Code.deed list
  | Halts of string * Shared.t * Code.deed list

type result = { world : World.t; outcome : outcome; mode : Code.mode }

(* Atomic code that evaluates more expressions counts as endless. *)
let fuel = 2_000_000

let nobody = lazy []

let context ?(held = nobody) ?(needed = nobody) program world (s : Shared.t) mode : Code.context =
  { program; world; allocation = s.allocation; bound = s.bound; held; needed; store = s.store;
    tuples = s.tuples; mode; deeds = [] }

let after (context : Code.context) (s : Shared.t) =
  { s with bound = context.bound; store = context.store; tuples = context.tuples }

let kept program world (s : Shared.t) =
  if World.is_open world then { s with store = Reading.keep program s.store } else s

let action_of : Code.deed -> Effect.t option = function
  | Posted _ | Consumed _ -> None
  | Said text -> Some (Say text)
  | Released vs -> Some (Release vs)
  | Set_connection_timeout (vs, seconds) -> Some (Set_connection_timeout (vs, seconds))

let is_said : Code.deed -> bool = function
  | Said _ -> true
  | Posted _ | Consumed _ | Released _ | Set_connection_timeout _ -> false

let said deeds = List.filter is_said deeds
let effects deeds = List.filter_map action_of deeds

let run ?needed held program world s mode closure arguments =
  let result (stop, _, (context : Code.context)) =
    let deeds = List.rev context.deeds in
    let outcome =
      match (stop : Machine.stop) with
      | Finished x -> Gives (x, after context s, deeds)
      | Halted message -> Halts (message, after context s, deeds)
      | Faulted fault -> Faulty (fault, said deeds)
      | Exhausted ->
        let message = "this code does not come to an end, and code inside of a task is atomic" in
        (* It may have printed any number of messages. *)
        Faulty (Fault.make closure.lambda.lambda_site message, [])
      | Did _ | Waits _ | Left_off -> invalid_arg "Run_code.run: atomic code stopped"
    in
    { world = context.world; outcome; mode = context.mode }
  in
  Decision.map result (Machine.run ~fuel (context ~held ?needed program world s mode) (Machine.call closure arguments))

let atomic ?(held = nobody) ?(given = []) program world s closure = run held program world s Task_code closure given

(* The error, with the vehicle and the task that failed, if it was one. *)
let handler ~held ~needed program world s closure (fault : Fault.t) =
  let vehicle, task =
    match fault.cause with
    | Task { vehicle; task } -> (Vehicles [ vehicle ], String task)
    | Code | Assertion | Unknown -> (Null, Null)
  in
  run ~needed held program world s (Handler Propagated) closure [ String fault.message; vehicle; task ]
