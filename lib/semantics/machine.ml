open Core

type deed =
  | Posted of (string * value) list
  | Consumed of (string * value) list
  | Said of string
  | Released of vehicle list
  | Set_connection_timeout of vehicle list option * float

type verdict = Ignored | Propagated
type mode = Script | Task_code | Handler of verdict

type context = {
  program : program;
  world : World.t;
  bound : vehicle list;
  store : Store.t;
  tuples : Tuples.t;
  mode : mode;
  deeds : deed list;
}

(* What a method that calls a closure for each item does with the results. *)
type iteration =
  | Each | Collect | Find_all | Find | Any | Every | Count | Sum | Inject | Sort | Greatest | Least

(* What a loop has yet to go through: elements from an index on, or numbers up to and with the last, up or down. *)
type items = Items of value array * int | Counting of int * int

type frame =
  | Arguments of { operation : operation; at : site; evaluated : value list; remaining : expression list }
  | Assign_local of int
  | Assign_global of int
  | Choose of expression * expression
  | Rest of expression list
  | Loop_test of expression * expression
  | Loop_body of expression * expression
  | Next_item of int * items * expression
  | Leave of value array
  | Iterate of {
      iteration : iteration;
      closure : closure;
      subject : value;
      items : value array;
      index : int;  (* of the item whose result is awaited *)
      gathered : value list;  (* latest first *)
      at : site;
    }

type focus = Evaluate of expression | Give of value

type t = { focus : focus; locals : value array; stack : frame list; calls : int; at : site }

let site m = match m.focus with Evaluate e -> e.site | Give _ -> m.at

(* Order. An expression is known by its site, which elaboration makes unique. *)

let both first second = if first <> 0 then first else second ()

let compare_expression (e : expression) (e' : expression) = Int.compare e.site e'.site

let compare_items a b =
  match a, b with
  | Items (xs, i), Items (ys, j) -> both (Int.compare i j) (fun () -> Value.compare (List xs) (List ys))
  | Counting (i, n), Counting (j, m) -> both (Int.compare i j) (fun () -> Int.compare n m)
  | Items _, Counting _ -> -1
  | Counting _, Items _ -> 1

let rank_frame = function
  | Arguments _ -> 0 | Assign_local _ -> 1 | Assign_global _ -> 2 | Choose _ -> 3 | Rest _ -> 4 | Loop_test _ -> 5
  | Loop_body _ -> 6 | Next_item _ -> 7 | Leave _ -> 8 | Iterate _ -> 9

let values xs = List (Array.of_list xs)

let compare_frame a b =
  match a, b with
  | Arguments a, Arguments b ->
    both (Int.compare a.at b.at) (fun () ->
        both (List.compare_lengths a.remaining b.remaining) (fun () ->
            Value.compare (values a.evaluated) (values b.evaluated)))
  | Assign_local i, Assign_local j | Assign_global i, Assign_global j -> Int.compare i j
  | Choose (e, _), Choose (e', _) | Loop_test (e, _), Loop_test (e', _) | Loop_body (e, _), Loop_body (e', _) ->
    compare_expression e e'
  | Rest es, Rest es' -> List.compare compare_expression es es'
  | Next_item (i, items, e), Next_item (j, items', e') ->
    both (Int.compare i j) (fun () ->
        both (compare_expression e e') (fun () -> compare_items items items'))
  | Leave xs, Leave ys -> Value.compare (List xs) (List ys)
  | Iterate a, Iterate b ->
    both (Int.compare a.at b.at) (fun () ->
        both (Int.compare a.index b.index) (fun () ->
            both (Value.compare_closure a.closure b.closure) (fun () ->
                both (Value.compare (List a.items) (List b.items)) (fun () ->
                    Value.compare (values a.gathered) (values b.gathered)))))
  | ( ( Arguments _ | Assign_local _ | Assign_global _ | Choose _ | Rest _ | Loop_test _ | Loop_body _ | Next_item _
      | Leave _ | Iterate _ ),
      _ ) -> Int.compare (rank_frame a) (rank_frame b)

let compare_focus a b =
  match a, b with
  | Evaluate e, Evaluate e' -> compare_expression e e'
  | Give x, Give y -> Value.compare x y
  | Evaluate _, Give _ -> -1
  | Give _, Evaluate _ -> 1

let compare m m' =
  if m == m' then 0
  else
    both (compare_focus m.focus m'.focus) (fun () ->
        both (Int.compare m.at m'.at) (fun () ->
            both (Value.compare (List m.locals) (List m'.locals)) (fun () ->
                List.compare compare_frame m.stack m'.stack)))

let hash m =
  let focus = match m.focus with Evaluate e -> e.site | Give x -> Value.hash x in
  let frame h = function
    | Arguments a -> (h * 31) + a.at
    | Next_item (_, Items (_, i), _) | Next_item (_, Counting (i, _), _) -> (h * 31) + i
    | Iterate i -> (h * 31) + i.index
    | (Assign_local _ | Assign_global _ | Choose _ | Rest _ | Loop_test _ | Loop_body _ | Leave _) as f ->
      (h * 31) + rank_frame f
  in
  (List.fold_left frame focus m.stack * 65599) + Value.hash (List m.locals) + m.at

type request =
  | Pick of Settings.pick
  | Ask of string
  | Pause of float
  | Execute of task
  | Host_call of { subject : string option; member : string; arguments : value list option }

let compare_request a b =
  match a, b with
  | Pick a, Pick b -> Settings.compare_pick a b
  | Ask a, Ask b -> String.compare a b
  | Pause a, Pause b -> Float.compare a b
  | Execute a, Execute b -> Value.compare_task a b
  | Host_call a, Host_call b ->
    let arguments = Option.compare (fun xs ys -> Value.compare (values xs) (values ys)) in
    both (Option.compare String.compare a.subject b.subject) (fun () ->
        both (String.compare a.member b.member) (fun () -> arguments a.arguments b.arguments))
  | (Pick _ | Ask _ | Pause _ | Execute _ | Host_call _), _ ->
    let rank = function Pick _ -> 0 | Ask _ -> 1 | Pause _ -> 2 | Execute _ -> 3 | Host_call _ -> 4 in
    Int.compare (rank a) (rank b)

type stop =
  | Exhausted
  | Finished of value
  | Did
  | Waits of request
  | Halted of string
  | Faulted of Fault.t

(* The result of an operation whose arguments are values. *)
type outcome =
  | Value of value
  | Done of context * value  (* with deeds, or a verdict *)
  | Enter of closure * value list
  | Walk of iteration * closure * value * value array * value list  (* subject, its items; initial results *)
  | Wait of request
  | Stop of string
  | Wrong of string  (* a fault of this very operation *)
  | Wrong_at of Fault.t

let maximum_calls = 10_000

let locals_of closure arguments =
  let { lambda; captured } = closure in
  let locals = Array.make lambda.slots Null in
  List.iteri (fun i x -> if i < lambda.parameters then locals.(i) <- x) arguments;
  Array.iteri (fun i slot -> locals.(slot) <- captured.(i)) lambda.captures;
  locals

let call closure arguments =
  let code = closure.lambda.code in
  { focus = Evaluate code; locals = locals_of closure arguments; stack = []; calls = 0; at = code.site }

let give x m = { m with focus = Give x }

let of_result = function Ok x -> Value x | Error message -> Wrong message

let expected what x = of_result (Operators.expected what x)

let did context deed = { context with deeds = deed :: context.deeds }

(* {1 Built-in operations} *)

let make_task = function
  | Platform_task, [ String "" ] -> Wrong "a plan's name may not be empty"
  | Platform_task, [ x ] -> expected "the name of a plan, a string" x
  | Make_action, [ Closure c ] -> Value (Task (Action c))
  | Make_condition, [ Closure c ] -> Value (Task (Condition c))
  | (Make_action | Make_condition), [ x ] -> expected "code { ... }" x
  | Make_wait_for, [ Closure guard; Task body ] -> Value (Task (One_of [ { guard; body } ]))
  | Make_until, [ Closure c; Task t ] -> Value (Task (Until (c, t)))
  | (Make_wait_for | Make_until), ([ Closure _; x ] | [ x; _ ]) -> expected "a task" x
  | Make_watch, [ Task t; Closure c ] -> Value (Task (Watch (t, c)))
  | Make_watch, (x :: _) -> expected "a task after watch" x
  | Make_idle, [ x ] -> (
      match Value.to_number x with
      | Some seconds when seconds >= 0. && seconds < infinity -> Value (Task (Idle seconds))
      | Some seconds -> Wrong (Printf.sprintf "idle takes a time of 0 seconds or more, not %g" seconds)
      | None -> expected "a time after idle, as in idle(10.seconds)" x)
  | Make_during, [ Closure c; Task t ] -> Value (Task (During (Given_by c, t)))
  | Make_during, [ x; Task t ] -> (
      match Value.to_number x with
      | Some seconds when seconds >= 0. && seconds < infinity -> Value (Task (During (Seconds seconds, t)))
      | Some seconds -> Wrong (Printf.sprintf "during takes a time of 0 seconds or more, not %g" seconds)
      | None -> expected "a time after during, as in during 10.minutes run T" x)
  | Make_during, [ _; x ] -> expected "a task" x
  | _, _ -> Wrong "this construct has the wrong number of parts"

let rec allocate_each names arguments tasks =
  match names, arguments with
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

let pair keys arguments = List.map2 (fun k x -> (k, Value.canonical x)) keys arguments

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
  | Some (tuples, taken) -> Done (did { context with tuples } (Consumed (List.rev taken)), Boolean true)

let poll context pairs =
  let there (k, x) =
    match x with
    | Wildcard -> Tuples.poll_any k context.tuples
    | x -> Tuples.poll k x context.tuples
  in
  Value (Boolean (List.for_all there pairs))

let one_vehicle context = function
  | Vehicles [ v ] -> (
      match World.find v context.world with
      | Some state -> Ok state
      | None -> Error (Error (Printf.sprintf "nothing is known of vehicle %s" v)))
  | Vehicles vs ->
    Error (Error (Printf.sprintf "the set must be a single vehicle, it has %d" (List.length vs)))
  | x -> Error (Operators.expected "a vehicle" x)

let minimum_connection_timeout = 5.
let maximum_connection_timeout = 3600.

let set_connection_timeout context vehicles x =
  match Value.to_number x with
  | None -> expected "a time, as in 2.min" x
  | Some seconds when seconds < minimum_connection_timeout || seconds > maximum_connection_timeout ->
    Wrong (Printf.sprintf "a connection timeout is from 5 seconds to 1 hour, not %g seconds" seconds)
  | Some seconds -> Done (did context (Set_connection_timeout (vehicles, seconds)), Null)

let numbers arguments =
  let numbers = List.filter_map Value.to_number arguments in
  if List.compare_lengths numbers arguments = 0 then Some numbers else None

let mathematics name arguments =
  let whole f = if Float.abs f < 0x1p62 then Value (Integer (int_of_float f)) else Value (Number f) in
  let result f = if Float.is_nan f then Wrong (Printf.sprintf "Math.%s has no result there" name) else Value (Number f) in
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
      | "toRadians" -> result (a *. Float.pi /. 180.)
      | "toDegrees" -> result (a *. 180. /. Float.pi)
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
  | Handler _ -> Done ({ context with mode = Handler verdict }, Null)
  | Script | Task_code -> Wrong "ignore() and propagate() belong in onError { ... }"

let builtin context at operation arguments =
  match operation, arguments with
  | Platform_task, [ String name ] when name <> "" ->
    Value (Task (Platform { name; plan = None; task_site = at }))
  | ( (Platform_task | Make_action | Make_condition | Make_wait_for | Make_until | Make_idle | Make_during | Make_watch),
      _ ) -> make_task (operation, arguments)
  | Execute, [ Task t ] -> blocking context "execute" (Execute t)
  | Execute, [ x ] -> expected "a task to execute" x
  | Execute_for names, arguments -> (
      match allocate_each names arguments [] with
      | Ok t -> blocking context "execute" (Execute t)
      | Error e -> of_result e)
  | Release, [ Vehicles vs ] -> (
      match context.mode with
      | Script -> (
          match Operators.binary Intersect (Vehicles vs) (Vehicles context.bound) with
          | Ok (Vehicles []) -> Value Null
          | Ok (Vehicles bound) -> Done (did context (Released bound), Null)
          | Ok x -> expected "a vehicle set" x
          | Error message -> Wrong message)
      | Task_code | Handler _ -> Wrong "release belongs to the script, not to code inside of a task")
  | Release, [ x ] -> expected "a vehicle set to release" x
  | Set_connection_timeout, [ x ] -> set_connection_timeout context None x
  | Set_connection_timeout, [ Vehicles vs; x ] -> set_connection_timeout context (Some vs) x
  | Set_connection_timeout, [ x; _ ] -> expected "a vehicle set" x
  | Ask, [ prompt ] -> blocking context "ask" (Ask (Value.to_string prompt))
  | Message, [ x ] -> Done (did context (Said (Value.to_string x)), Null)
  | Pause, [ x ] -> (
      match Value.to_number x with
      | Some seconds when seconds >= 0. && seconds < infinity -> blocking context "pause" (Pause seconds)
      | Some seconds -> Wrong (Printf.sprintf "pause takes a time of 0 seconds or more, not %g" seconds)
      | None -> expected "a time after pause, as in pause 12.seconds" x)
  | Halt, [] -> Stop ""
  | Halt, [ x ] -> Stop (Value.to_string x)
  | Post keys, arguments ->
    let pairs = pair keys arguments in
    if List.exists (function _, Wildcard -> true | _, _ -> false) pairs then Wrong "only consume and poll take the wildcard _"
    else
      let tuples = List.fold_left (fun n (k, x) -> Tuples.post k x n) context.tuples pairs in
      Done (did { context with tuples } (Posted pairs), Null)
  | Consume keys, arguments -> consume context (pair keys arguments)
  | Poll [], [ String k ] -> poll context [ (k, Wildcard) ]
  | Poll [], [ x ] -> expected "a key, as in poll 'ready', or pairs, as in poll(ready: 1)" x
  | Poll keys, arguments -> poll context (pair keys arguments)
  | Position_of, [ x ] -> (
      match one_vehicle context x with
      | Ok state -> Value (Position state.position)
      | Error e -> of_result e)
  | Battery_of, [ x ] -> (
      match one_vehicle context x with Ok state -> Value (Number state.battery) | Error e -> of_result e)
  | Location_of, ([ _; _ ] | [ _; _; _ ]) -> (
      match numbers arguments with
      | Some (latitude :: longitude :: height) -> (
          let height = match height with h :: _ -> h | [] -> 0. in
          match Dolphin_geo.Position.make ~latitude ~longitude ~height with
          | Ok p -> Value (Position p)
          | Error e -> Wrong (Format.asprintf "%a" Dolphin_geo.Position.pp_error e))
      | Some [] | Some [ _ ] | None -> Wrong "location takes latitude and longitude in degrees, and a height in metres")
  | Area_of, [ centre; radius ] -> of_result (Operators.binary Around centre radius)
  | Ignore, [] -> settle context Ignored
  | Propagate, [] -> settle context Propagated
  | Get_supplier, [] ->
    blocking context "getSupplier" (Host_call { subject = None; member = "getSupplier"; arguments = Some [] })
  | Is_host, [ x ] -> Value (Boolean (match x with Host _ -> true | _ -> false))
  | Math name, arguments -> mathematics name arguments
  | ( ( Execute | Release | Set_connection_timeout | Ask | Message | Pause | Halt | Position_of | Battery_of
      | Location_of | Area_of | Ignore | Propagate | Get_supplier | Is_host ),
      _ ) -> Wrong (Printf.sprintf "wrong number of arguments, %d" (List.length arguments))

(* {1 Methods that call closures} *)

let iteration_of name arguments =
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

let collection subject name =
  match subject, name with
  | Integer n, "times" when n > Value.most_items -> None
  | Integer n, "times" -> Some (Array.init (max n 0) (fun i -> Integer i))
  | _, _ -> Value.items subject

(* A closure with two parameters gets key and value of a map's entry, or item and index. *)
let item_arguments iteration closure subject item index gathered =
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
  | _ -> List (Array.of_list items)

let by_result items results =
  let order (_, a) (_, b) =
    match Value.to_number a, Value.to_number b with
    | Some a, Some b -> Float.compare a b
    | _, _ -> Value.compare a b
  in
  List.stable_sort order (List.combine (Array.to_list items) results)

(* [conclude iteration subject items gathered] is what the method gives once every item had its call. *)
let conclude iteration subject items gathered =
  let results = List.rev gathered in
  match iteration with
  | Each -> Value subject
  | Collect -> Value (List (Array.of_list results))
  | Find_all ->
    let kept = List.combine (Array.to_list items) results in
    Value (same_kind subject (List.filter_map (fun (x, r) -> if Value.truth r then Some x else None) kept))
  | Find -> Value Null
  | Any -> Value (Boolean false)
  | Every -> Value (Boolean true)
  | Count -> Value (Integer (List.length (List.filter Value.truth results)))
  | Sum ->
    let add total x = Result.bind total (fun total -> Operators.binary Add total x) in
    of_result (List.fold_left add (Ok (Integer 0)) results)
  | Inject -> Value (match gathered with x :: _ -> x | [] -> Null)
  | Sort -> Value (same_kind subject (List.map fst (by_result items results)))
  | Greatest -> Value (match List.rev (by_result items results) with (x, _) :: _ -> x | [] -> Null)
  | Least -> Value (match by_result items results with (x, _) :: _ -> x | [] -> Null)

(* Some methods know their result before the last item. *)
let early iteration item result =
  match iteration with
  | Find when Value.truth result -> Some item
  | Any when Value.truth result -> Some (Boolean true)
  | Every when not (Value.truth result) -> Some (Boolean false)
  | Each | Collect | Find_all | Find | Any | Every | Count | Sum | Inject | Sort | Greatest | Least -> None

(* {1 Operations} *)

(* Named arguments of methods and of the program's own functions come as a map, first, as in Groovy. *)
let with_named names arguments =
  let named = List.combine names arguments in
  let positional = List.filter_map (function None, x -> Some x | Some _, _ -> None) named in
  match List.filter_map (function Some k, x -> Some (k, x) | None, _ -> None) named with
  | [] -> positional
  | entries -> Map entries :: positional

let make_map keys arguments =
  let rec entries keys arguments map =
    match keys, arguments with
    | Some k :: keys, x :: arguments -> add keys arguments map (String k) x
    | None :: keys, k :: x :: arguments -> add keys arguments map k x
    | _, _ -> Ok map
  and add keys arguments map k x = Result.bind (Operators.replace_element map k x) (entries keys arguments) in
  entries keys arguments (Map [])

let build context at builder name arguments =
  match (builder : Dolphin_syntax.Ast.builder), arguments with
  | builder, [ Settings latest_first ] -> (
      let settings = List.rev latest_first in
      let value to_value = function Ok x -> Value (to_value x) | Error fault -> Wrong_at fault in
      match builder with
      | Pick -> (
          match Settings.pick settings with
          | Ok pick -> blocking context "pick" (Pick pick)
          | Error fault -> Wrong_at fault)
      | Imc_plan ->
        value
          (fun plan -> Task (Platform { name = plan.Plan.name; plan = Some plan; task_site = at }))
          (Plan_builder.build ~name at settings)
      | Pos -> value Fun.id (Settings.position at settings)
      | All_of -> value (fun branches -> Task (All_of branches)) (Settings.branches at settings)
      | One_of -> value (fun branches -> Task (One_of branches)) (Settings.branches at settings))
  | _, _ -> Wrong "a block of settings is missing"

let add_setting at setting names arguments =
  match arguments with
  | Settings so_far :: arguments ->
    let all = List.combine names arguments in
    let positional = List.filter_map (function None, x -> Some x | Some _, _ -> None) all in
    let named = List.filter_map (function Some k, x -> Some (k, x) | None, _ -> None) all in
    Value (Settings ({ setting; positional; named; setting_site = at } :: so_far))
  | _ -> Wrong (Printf.sprintf "'%s' stands outside of a block of settings" setting)

let host_call context subject member arguments =
  blocking context
    (Printf.sprintf "%s.%s" subject member)
    (Host_call { subject = Some subject; member; arguments })

let call_method context name names arguments =
  match with_named names arguments with
  | Host subject :: arguments -> host_call context subject name (Some arguments)
  | Closure c :: arguments when name = "call" -> Enter (c, arguments)
  | Map entries :: arguments when (match List.assoc_opt name entries with Some (Closure _) -> true | _ -> false) -> (
      match List.assoc name entries with
      | Closure c -> Enter (c, arguments)
      | x -> expected "a closure" x)
  | subject :: arguments -> (
      match iteration_of name arguments, lazy (collection subject name) with
      | Some (iteration, closure, initial), (lazy (Some items)) -> Walk (iteration, closure, subject, items, initial)
      | (Some _ | None), _ -> of_result (Methods.call context.world subject name arguments))
  | [] -> Wrong "a method needs something to be called on"

let apply context at operation arguments =
  match operation, arguments with
  | Unary op, [ x ] -> of_result (Operators.unary op x)
  | Binary Parallel, [ (Vehicles _ as vs); Closure c ] ->
    Walk (Find_all, c, vs, Option.value (Value.items vs) ~default:[||], [])
  | Binary op, [ x; y ] -> of_result (Operators.binary op x y)
  | Make_list, xs -> Value (List (Array.of_list xs))
  | Make_map keys, arguments -> of_result (make_map keys arguments)
  | Make_range inclusive, [ first; last ] -> of_result (Operators.range ~inclusive first last)
  | Concatenate, parts -> Value (String (String.concat "" (List.map Value.to_string parts)))
  | Element, [ x; i ] -> of_result (Operators.element x i)
  | Replace_element, [ x; i; y ] -> of_result (Operators.replace_element x i y)
  | Replace_member k, [ x; y ] -> of_result (Operators.replace_element x (String k) y)
  | Property name, [ Host subject ] -> host_call context subject name None
  | Property name, [ x ] -> of_result (Methods.property context.world x name)
  | Call names, Closure c :: arguments -> Enter (c, with_named names arguments)
  | Call _, x :: _ -> expected "a function or closure to call" x
  | Method (name, names), (_ :: _ as arguments) -> call_method context name (None :: names) arguments
  | Builtin b, arguments -> builtin context at b arguments
  | Add_setting (name, names), arguments -> add_setting at name names arguments
  | Build (builder, name), arguments -> build context at builder name arguments
  | Make_branch, arguments -> add_setting at "when" [ None; None ] arguments
  | ( ( Unary _ | Binary _ | Make_range _ | Element | Replace_element | Replace_member _ | Property _ | Call _
      | Method _ ),
      _ ) -> Wrong "wrong number of operands"

let arity_fault (lambda : lambda) n =
  if n = lambda.parameters || (lambda.implicit && n = 0) then None
  else
    Some
      (Printf.sprintf "%s takes %d argument%s, not %d" lambda.label lambda.parameters
         (if lambda.parameters = 1 then "" else "s")
         n)

(* {1 The loop} *)

let machine focus locals stack calls at = { focus; locals; stack; calls; at }
let fault context m at message = (Faulted (Fault.make at message), m, context)

let set_local locals slot x =
  let locals = Array.copy locals in
  locals.(slot) <- x;
  locals

let rec evaluate context fuel (e : expression) locals stack calls =
  if fuel <= 0 then (Exhausted, machine (Evaluate e) locals stack calls e.site, context)
  else
    let fuel = fuel - 1 in
    let continue x = proceed context fuel x locals stack calls e.site in
    match e.node with
    | Constant x -> continue x
    | Local slot -> continue locals.(slot)
    | Global i -> (
        match Store.find i context.store with
        | Some x -> continue x
        | None ->
          let m = machine (Evaluate e) locals stack calls e.site in
          fault context m e.site
            (Printf.sprintf "'%s' has no value yet" context.program.global_names.(i)))
    | Set_local (slot, e) -> evaluate context fuel e locals (Assign_local slot :: stack) calls
    | Set_global (i, e) -> evaluate context fuel e locals (Assign_global i :: stack) calls
    | Apply (operation, []) -> perform context fuel operation e.site [] locals stack calls
    | Apply (operation, first :: remaining) ->
      evaluate context fuel first locals
        (Arguments { operation; at = e.site; evaluated = []; remaining } :: stack)
        calls
    | Make_closure (lambda, slots) ->
      let captured = Array.of_list (List.map (fun slot -> locals.(slot)) slots) in
      continue (Closure { lambda; captured })
    | If (test, yes, no) -> evaluate context fuel test locals (Choose (yes, no) :: stack) calls
    | Block [] -> continue Null
    | Block [ last ] -> evaluate context fuel last locals stack calls
    | Block (first :: rest) -> evaluate context fuel first locals (Rest rest :: stack) calls
    | While (test, body) -> evaluate context fuel test locals (Loop_test (test, body) :: stack) calls
    | For (slot, range, body) ->
      evaluate context fuel range locals (Next_item (slot, Items ([||], -1), body) :: stack) calls
    | Return e -> evaluate context fuel e locals (leave stack) calls
    | Break -> proceed context fuel Null locals (after_loop stack) calls e.site
    | Continue -> proceed context fuel Null locals (to_loop stack) calls e.site

(* Frames between here and the end of the function, or of the script, are dropped. *)
and leave = function
  | (Leave _ :: _ | []) as stack -> stack
  | _ :: stack -> leave stack

and after_loop = function
  | (Loop_body _ | Next_item _) :: stack -> stack
  | _ :: stack -> after_loop stack
  | [] -> []

and to_loop = function
  | (Loop_body _ | Next_item _) :: _ as stack -> stack
  | _ :: stack -> to_loop stack
  | [] -> []

and proceed context fuel x locals stack calls at =
  match stack with
  | [] -> (Finished x, machine (Give x) locals [] calls at, context)
  | frame :: stack -> (
      match frame with
      | Arguments { operation; at; evaluated; remaining = [] } ->
        perform context fuel operation at (List.rev (x :: evaluated)) locals stack calls
      | Arguments ({ evaluated; remaining = next :: remaining; _ } as a) ->
        evaluate context fuel next locals
          (Arguments { a with evaluated = x :: evaluated; remaining } :: stack)
          calls
      | Assign_local slot -> proceed context fuel x (set_local locals slot x) stack calls at
      | Assign_global i ->
        proceed { context with store = Store.set i x context.store } fuel x locals stack calls at
      | Choose (yes, no) -> evaluate context fuel (if Value.truth x then yes else no) locals stack calls
      | Rest [] -> proceed context fuel x locals stack calls at
      | Rest [ last ] -> evaluate context fuel last locals stack calls
      | Rest (next :: rest) -> evaluate context fuel next locals (Rest rest :: stack) calls
      | Loop_test (test, body) ->
        if Value.truth x then evaluate context fuel body locals (Loop_body (test, body) :: stack) calls
        else proceed context fuel Null locals stack calls at
      | Loop_body (test, body) -> evaluate context fuel test locals (Loop_test (test, body) :: stack) calls
      | Next_item (slot, Items (_, -1), body) -> begin_loop context fuel x slot body locals stack calls at
      | Next_item (slot, items, body) -> next_item context fuel slot items body locals stack calls at
      | Leave callers -> proceed context fuel x callers stack (calls - 1) at
      | Iterate i -> (
          let item = i.items.(i.index) in
          match early i.iteration item x with
          | Some result -> proceed context fuel result locals stack calls i.at
          | None ->
            iterate context fuel
              (Iterate { i with gathered = x :: i.gathered; index = i.index + 1 })
              locals stack calls))

and begin_loop context fuel x slot body locals stack calls at =
  let start items = next_item context fuel slot items body locals stack calls at in
  match x with
  | Range (first, last) -> start (Counting (first, last))
  | Null -> proceed context fuel Null locals stack calls at
  | x -> (
      match Value.items x with
      | Some items -> start (Items (items, 0))
      | None -> (
          let m = machine (Give x) locals stack calls at in
          match Operators.expected "a list, range, map, string or vehicle set to loop over" x with
          | Ok () -> assert false
          | Error message -> fault context m at message))

and next_item context fuel slot items body locals stack calls at =
  let go x items =
    evaluate context fuel body (set_local locals slot x) (Next_item (slot, items, body) :: stack) calls
  in
  match items with
  | Items (xs, i) when i < Array.length xs -> go xs.(i) (Items (xs, i + 1))
  | Counting (i, last) when i = last -> go (Integer i) (Items ([||], 0))
  | Counting (i, last) -> go (Integer i) (Counting ((if i < last then i + 1 else i - 1), last))
  | Items _ -> proceed context fuel Null locals stack calls at

and iterate context fuel frame locals stack calls =
  match frame with
  | Iterate i when i.index < Array.length i.items ->
    let item = i.items.(i.index) in
    let arguments = item_arguments i.iteration i.closure i.subject item i.index i.gathered in
    enter context fuel i.closure arguments i.at locals (frame :: stack) calls
  | Iterate i ->
    settle_outcome context fuel (conclude i.iteration i.subject i.items i.gathered) i.at locals stack calls
  | _ -> invalid_arg "Machine.iterate"

and enter context fuel closure arguments at locals stack calls =
  match arity_fault closure.lambda (List.length arguments) with
  | Some message -> fault context (machine (Give Null) locals stack calls at) at message
  | None when calls >= maximum_calls ->
    fault context
      (machine (Give Null) locals stack calls at)
      at
      (Printf.sprintf "calls nest more than %d deep: does %s call itself without end?" maximum_calls
         closure.lambda.label)
  | None ->
    (* A call in tail position needs no frame of its own: its caller's locals are not looked at again. *)
    let stack, calls =
      match stack with Leave _ :: _ -> (stack, calls) | [] | _ :: _ -> (Leave locals :: stack, calls + 1)
    in
    evaluate context fuel closure.lambda.code (locals_of closure arguments) stack calls

and perform context fuel operation at arguments locals stack calls =
  settle_outcome context fuel (apply context at operation arguments) at locals stack calls

and settle_outcome context fuel outcome at locals stack calls =
  let stopped focus = machine focus locals stack calls at in
  match outcome with
  | Value x -> proceed context fuel x locals stack calls at
  | Done (context, x) -> (
      match context.mode with
      | Script -> (Did, stopped (Give x), context)
      | Task_code | Handler _ -> proceed context fuel x locals stack calls at)
  | Enter (closure, arguments) -> enter context fuel closure arguments at locals stack calls
  | Walk (iteration, closure, subject, items, gathered) ->
    iterate context fuel
      (Iterate { iteration; closure; subject; items; index = 0; gathered; at })
      locals stack calls
  | Wait request -> (Waits request, stopped (Give Null), context)
  | Stop message -> (Halted message, stopped (Give Null), context)
  | Wrong message -> fault context (stopped (Give Null)) at message
  | Wrong_at f -> (Faulted f, stopped (Give Null), context)

let run ~fuel context m =
  match m.focus with
  | Evaluate e -> evaluate context fuel e m.locals m.stack m.calls
  | Give x -> proceed context fuel x m.locals m.stack m.calls m.at
