module Ast = Dolphin_syntax.Ast
module Location = Dolphin_syntax.Location
module Diagnostic = Dolphin_syntax.Diagnostic

type purpose = Main | Named_function of string | Plain | Task_code of string | Maker | Handler

type global = { index : int; mutable assigned : bool; mutable uses : Location.t list }

type call = { caller : string option; in_task : string option; callee : string; at : Location.t }

type program = {
  variables : Assigned.Names.t;
  parameters : string list;
  given : Assigned.Names.t option;  (* the variables that get a first value; [None]: not known *)
  suppliers : Assigned.Names.t;
  kinds : (Builtins.kind * Assigned.Names.t) list;
  chart : string -> (Chart.t, string) result;
  charted : (string, string * Chart.t) Hashtbl.t;  (* variables that are a chart, with its file *)
  functions : (string, Core.lambda) Hashtbl.t;
  table : (string, global) Hashtbl.t;
  mutable global_names : string list;  (* latest first *)
  mutable locations : Location.t list;  (* latest first *)
  mutable sites : int;
  mutable lambdas : int;
  mutable reports : Diagnostic.t list;
  ordered_keys : (string, unit) Hashtbl.t;
  mutable inputs : string Ast.located list;  (* latest first *)
  mutable vehicle_inputs : string list;  (* latest first *)
  input_keys : (string, unit) Hashtbl.t;
  mutable on_interrupt : Core.lambda option;
  looked_at : (string, unit) Hashtbl.t;  (* the keys that code consumes or polls *)
  mutable looks_at_any : bool;
  mutable computed_ordered : Location.t list;
  mutable hints : (Location.t * (bool * (string -> string))) list;  (* for names that are unknown *)
  mutable recruits : bool;
  mutable goes_round : bool;
  mutable reads_sensors : bool;
  mutable reads_now : bool;
  mutable reads_time_of_day : bool;
  mutable asks_running : bool;
  mutable calls : call list;
  blocking : (string, string) Hashtbl.t;  (* function, and the names that it uses *)
}

let global program name =
  match Hashtbl.find_opt program.table name with
  | Some global -> global
  | None ->
    let global = { index = Hashtbl.length program.table; assigned = false; uses = [] } in
    Hashtbl.replace program.table name global;
    program.global_names <- name :: program.global_names;
    global

let assigned_global program name =
  let global = global program name in
  global.assigned <- true;
  global.index

let no_chart _ = Error "no file can be read here"

let create ?(first_site = 0) ?(variables = Assigned.Names.empty) ?(parameters = []) ?given
    ?(suppliers = Assigned.Names.empty) ?(kinds = []) ?(chart = no_chart) ~functions ~globals () =
  let program =
    {
      variables;
      parameters;
      given;
      suppliers;
      kinds;
      chart;
      charted = Hashtbl.create 4;
      functions = Hashtbl.create 16;
      table = Hashtbl.create 64;
      global_names = [];
      locations = [];
      sites = first_site;
      lambdas = 0;
      reports = [];
      ordered_keys = Hashtbl.create 16;
      inputs = [];
      vehicle_inputs = [];
      input_keys = Hashtbl.create 16;
      on_interrupt = None;
      looked_at = Hashtbl.create 16;
      looks_at_any = false;
      computed_ordered = [];
      hints = [];
      recruits = false;
      goes_round = false;
      reads_sensors = false;
      reads_now = false;
      reads_time_of_day = false;
      asks_running = false;
      calls = [];
      blocking = Hashtbl.create 16;
    }
  in
  List.iter (fun (name, lambda) -> Hashtbl.replace program.functions name lambda) functions;
  List.iter (fun name -> ignore (assigned_global program name)) globals;
  program

let site program at =
  program.locations <- at :: program.locations;
  program.sites <- program.sites + 1;
  program.sites - 1

let fresh_lambda_id program =
  program.lambdas <- program.lambdas + 1;
  program.lambdas - 1

let report program diagnostic = program.reports <- diagnostic :: program.reports
let reports program = List.stable_sort Diagnostic.compare (List.rev program.reports)
let locations program = Array.of_list (List.rev program.locations)
let location program site = List.nth_opt program.locations (program.sites - 1 - site)
let globals program = Array.of_list (List.rev program.global_names)
let add_function program name lambda = Hashtbl.replace program.functions name lambda
let find_function program name = Hashtbl.find_opt program.functions name

let is_assigned program name =
  Assigned.Names.mem name program.variables
  || match Hashtbl.find_opt program.table name with Some global -> global.assigned | None -> false

let used_global program name at =
  let global = global program name in
  global.uses <- at :: global.uses;
  global.index

let unknown program =
  Hashtbl.fold
    (fun name global unknown ->
       if global.assigned then unknown else List.map (fun at -> (name, at)) global.uses @ unknown)
    program.table []

let note_ordered_key program key = Hashtbl.replace program.ordered_keys key ()

let note_input program ~of_vehicle (key : string Ast.located) =
  program.inputs <- key :: program.inputs;
  if of_vehicle then program.vehicle_inputs <- key.it :: program.vehicle_inputs;
  Hashtbl.replace program.input_keys key.it ()

let is_input program key = Hashtbl.mem program.input_keys key
let note_interrupt program lambda = program.on_interrupt <- Some lambda
let on_interrupt program = program.on_interrupt
let inputs program = List.rev program.inputs
let vehicle_inputs program = List.rev program.vehicle_inputs

let note_looked_at program = function
  | Some key -> Hashtbl.replace program.looked_at key ()
  | None -> program.looks_at_any <- true

let is_looked_at program key = program.looks_at_any || Hashtbl.mem program.looked_at key

let note_computed_order program at = program.computed_ordered <- at :: program.computed_ordered

let ordered_keys program = Tuple_space.keys (Hashtbl.fold (fun key () keys -> key :: keys) program.ordered_keys [])
let computed_orders program = program.computed_ordered
let note_hint program ~certain at hint = program.hints <- (at, (certain, hint)) :: program.hints
let hint_at program at = List.assq_opt at program.hints
let note_recruit program = program.recruits <- true
let note_rounds program = program.goes_round <- true
let note_sensor program = program.reads_sensors <- true
let note_now program = program.reads_now <- true

let note_time_of_day program =
  note_now program;
  program.reads_time_of_day <- true

let note_running program = program.asks_running <- true
let has_first_value program name = match program.given with Some names -> Assigned.Names.mem name names | None -> true
let has_like program name = Diagnostic.suggest name (Assigned.Names.elements program.variables) <> None
let is_parameter program name = List.mem name program.parameters
let chart program path = program.chart path
let note_chart program name path chart = Hashtbl.replace program.charted name (path, chart)
let find_chart program name = Hashtbl.find_opt program.charted name
let kind_of_variable program name =
  let is_of (_, names) = Assigned.Names.mem name names in
  Option.fold (List.find_opt is_of program.kinds) ~none:Builtins.Any ~some:fst
let is_supplier program name = Assigned.Names.mem name program.suppliers
let recruits program = program.recruits
let goes_round program = program.goes_round
let reads_sensors program = program.reads_sensors
let reads_now program = program.reads_now
let reads_time_of_day program = program.reads_time_of_day
let asks_running program = program.asks_running

type code = {
  program : program;
  purpose : purpose;
  outer : code option;
  mutable names : (string * int) list;  (* the nearest first *)
  mutable slots : int;
  mutable captured : (string * (int * int)) list;  (* latest first *)
  mutable blocks : int;
  mutable loops : int;
  mutable builder : (Ast.builder * int) option;
}

let code program purpose outer =
  { program; purpose; outer; names = []; slots = 0; captured = []; blocks = 0; loops = 0; builder = None }

let purpose code = code.purpose

let rec in_handler code =
  match code.purpose, code.outer with
  | Handler, _ -> true
  | Plain, Some outer -> in_handler outer
  | (Main | Named_function _ | Plain | Task_code _ | Maker), _ -> false

let rec in_task code =
  match code.purpose, code.outer with
  | Task_code construct, _ -> Some construct
  | Maker, _ -> Some "a made task"
  | Handler, _ -> Some "onError"
  | (Main | Named_function _ | Plain), Some outer -> in_task outer
  | (Main | Named_function _ | Plain), None -> None

let rec may_give_task code =
  match code.purpose, code.outer with
  | (Maker | Handler), _ -> true
  | Plain, Some outer -> may_give_task outer
  | (Main | Named_function _ | Plain | Task_code _), _ -> false

let new_slot code =
  code.slots <- code.slots + 1;
  code.slots - 1

let slots code = code.slots

let define code name =
  let slot = new_slot code in
  code.names <- (name, slot) :: code.names;
  slot

let in_block code f =
  let names = code.names in
  code.blocks <- code.blocks + 1;
  let x = f () in
  code.blocks <- code.blocks - 1;
  code.names <- names;
  x

let at_top code = code.purpose = Main && code.blocks = 0

type local = Own of int | Captured of int

let rec find_local code name =
  match List.assoc_opt name code.names with
  | Some slot -> Some (Own slot)
  | None -> (
      match List.assoc_opt name code.captured, code.outer with
      | Some (_, slot), _ -> Some (Captured slot)
      | None, None -> None
      | None, Some outer -> (
          match find_local outer name with
          | None -> None
          | Some (Own outer_slot | Captured outer_slot) ->
            let slot = new_slot code in
            code.captured <- (name, (outer_slot, slot)) :: code.captured;
            Some (Captured slot)))

let field name field = name ^ "." ^ field

let rec has_fields code name =
  let hidden = field name "vehicle" in
  match List.find_opt (fun (n, _) -> String.equal n hidden || String.equal n name) code.names, code.outer with
  | Some (n, _), _ -> String.equal n hidden
  | None, Some outer -> has_fields outer name
  | None, None -> false

let captures code = List.rev_map snd code.captured
let in_loop code = code.loops > 0

let inside_loop code f =
  code.loops <- code.loops + 1;
  let x = f () in
  code.loops <- code.loops - 1;
  x

let settings code = code.builder

(* Around a closure that stands there. *)
let rec within_branches code =
  match code.builder, code.outer with
  | Some ((All_of | One_of), _), _ -> true
  | _, Some outer -> within_branches outer
  | _, None -> false

let inside_settings code builder f =
  let before = code.builder and loops = code.loops in
  code.builder <- builder;
  code.loops <- 0;
  let x = f () in
  code.builder <- before;
  code.loops <- loops;
  x

let rec local_names code =
  List.map fst code.names @ match code.outer with Some outer -> local_names outer | None -> []

let visible_names code =
  let program = code.program in
  let assigned = Hashtbl.fold (fun name g names -> if g.assigned then name :: names else names) program.table [] in
  let functions = Hashtbl.fold (fun name _ names -> name :: names) program.functions [] in
  local_names code @ assigned @ functions @ Builtins.names

let rec function_of code =
  match code.purpose, code.outer with
  | Named_function name, _ -> Some name
  | (Main | Plain | Task_code _ | Maker | Handler), Some outer -> function_of outer
  | (Main | Plain | Task_code _ | Maker | Handler), None -> None

let in_function code = function_of code <> None

(* The effects of a closure inside of a function count as the function's, unless it is code of a task. *)
let note_blocking code what =
  match in_task code, function_of code with
  | None, Some name ->
    if not (Hashtbl.mem code.program.blocking name) then Hashtbl.replace code.program.blocking name what
  | Some _, _ | None, None -> ()

let note_call code callee at =
  let call = { caller = function_of code; in_task = in_task code; callee; at } in
  code.program.calls <- call :: code.program.calls

let spread program =
  let reach call =
    match call.caller, call.in_task, Hashtbl.find_opt program.blocking call.callee with
    | Some caller, None, Some what when not (Hashtbl.mem program.blocking caller) ->
      Hashtbl.replace program.blocking caller what;
      true
    | _, _, _ -> false
  in
  let rec again () = if List.fold_left (fun any call -> reach call || any) false program.calls then again () in
  again ()

let blocking_calls_in_tasks program =
  spread program;
  List.filter_map
    (fun call ->
       match call.in_task, Hashtbl.find_opt program.blocking call.callee with
       | Some construct, Some what -> Some (construct, call.callee, what, call.at)
       | _, _ -> None)
    program.calls
