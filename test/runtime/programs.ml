open Dolphin_semantics.Core

(* Sites and the identifiers of closures are unique, over all programs. *)
let last = ref 0

let fresh () =
  incr last;
  !last

let expression node = { node; site = fresh () }
let constant x = expression (Constant x)
let string text = constant (String text)
let number x = constant (Number x)
let apply operation arguments = expression (Apply (operation, arguments))
let call b arguments = apply (Builtin b) arguments
let global i = expression (Global i)
let set_global i e = expression (Set_global (i, e))
let block es = expression (Block es)
let loop test body = expression (While (test, body))
let method_of subject name arguments =
  apply (Method (name, List.map (fun _ -> None) arguments)) (subject :: arguments)

let property subject name = apply (Property name) [ subject ]

let lambda label parameters code =
  { id = fresh (); label; parameters; implicit = false; captures = [||]; slots = parameters; code;
    lambda_site = fresh () }

let code e = expression (Make_closure (lambda "code" 0 e, []))
let handler e = expression (Make_closure (lambda "handler" 1 e, []))
let task name = call Platform_task [ string name ]
let sequence a b = apply (Binary Sequence) [ a; b ]
let parallel a b = apply (Binary Parallel) [ a; b ]
let repeat n f = List.init n (fun i -> f (i + 1))
let below a b = apply (Binary Less) [ a; b ]

let settings lines =
  let add so_far (name, x) = apply (Add_setting (name, [ None ])) [ so_far; constant x ] in
  List.fold_left add (constant (Settings [])) lines

let pick_with lines = apply (Build (Pick, "")) [ settings lines ]

let pick_all ?timeout () =
  pick_with (("count", Wildcard) :: Option.to_list (Option.map (fun t -> ("timeout", Number t)) timeout))

let pick n = pick_with [ ("count", Integer n) ]

let program ?(reads_sensors = false) ?(reads_now = false) ?(globals = 0) script =
  { source_name = "test.dol";
    locations = [||];
    global_names = Array.init globals (Printf.sprintf "g%d");
    functions = [];
    main = lambda "script" 0 (block script);
    ordered_keys = Dolphin_semantics.Tuple_space.no_key;
    inputs = [];
    vehicle_inputs = [];
    on_interrupt = None;
    recruits = false;
    goes_round = false;
    reads_sensors;
    reads_now;
    reads_time_of_day = false;
    asks_running = false;
    fences = Dolphin_plans.Fences.none;
    place = None;
    begins = None }

let on_interrupt t program =
  { program with on_interrupt = Some (lambda "onInterrupt" 1 (call Interrupted [ call Execute [ t ] ])) }
