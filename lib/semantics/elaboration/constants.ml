open Dolphin_plans
open Core
module Ast = Dolphin_syntax.Ast
module Diagnostic = Dolphin_syntax.Diagnostic
module String_map = Map.Make (String)
module String_set = Set.Make (String)

(* [own]: the program's own names, known or not. [charted]: variables that are a map, with its file. *)
type t = {
  known : value String_map.t;
  own : String_set.t;
  chart : string -> (Chart.t, string) result;
  place : Dolphin_geo.Position.t option;        (* of plans without a place *)
  charted : (string * string) list;
}

(* {1 What only computes} *)

let computing_calls = [ "location"; "area"; "imcPlan"; "task"; "map" ]

(* Of plans; [speed] is also a function of vehicles, which are not known. *)
let is_setting name = List.mem_assoc name Plan_builder.vocabulary || List.mem_assoc name Mission_builder.vocabulary

let computes constants locals (e : Ast.expression) =
  let is_own name = String_set.mem name constants.own in
  match e.it with
  | Variable name ->
    if String_map.mem name constants.known || String_set.mem name locals || not (is_own name) then None
    else Some (Printf.sprintf "the value of '%s' is not known before the program runs" name)
  | Call { callee = { it = Variable name; _ }; _ } ->
    if (not (is_own name)) && (List.mem name computing_calls || is_setting name || Builtins.is_geometry name) then None
    else if Builtins.find name = None && not (is_own name) then None  (* a setting, or a name that is unknown *)
    else Some (Printf.sprintf "%s(...) is not known before the program runs" name)
  | Call { callee = { it = Member { name; _ }; _ }; _ } when Methods.updates name.it ->
    Some (Printf.sprintf "%s(...) changes a variable" name.it)
  | Increment _ -> Some "this changes a variable"
  | Builder (Pick, _) | Pick_else _ -> Some "the vehicles of a pick are not known before the program runs"
  | _ -> None

let unknown constants (e : Ast.expression) =
  let locals = Assigned.names [ { Ast.it = Ast.Expression e; at = e.at } ] in
  let look found (e : Ast.expression) =
    match found with
    | Some _ -> found
    | None -> Option.map (fun why -> Diagnostic.error ~code:Bad_fence e.at why) (computes constants locals e)
  in
  Fold.expression look None e

(* {1 Computing} *)

let fuel = 2_000_000
let is_error (d : Diagnostic.t) = match d.severity with Error -> true | Warning -> false

(* The known variables that [e] names: with all of them, a list of n constants would take n * n steps and more. *)
let named constants (e : Ast.expression) =
  let rec add found (e : Ast.expression) =
    match e.it with
    | Variable name -> (
        match String_map.find_opt name constants.known with
        | Some x -> String_map.add name x found
        | None -> found)
    | Map entries -> List.fold_left key found entries
    | _ -> found
  and key found ((k : Ast.key Ast.located), _) =
    match k.it with Computed k -> Fold.expression add found k | Name _ -> found
  in
  String_map.bindings (Fold.expression add String_map.empty e)

let elaborated constants (e : Ast.expression) =
  let globals = named constants e in
  let program = Scope.create ~chart:constants.chart ~functions:[] ~globals:(List.map fst globals) () in
  let lambda = Lambdas.shell program e.at "constant" 0 in
  List.iter (Chart_calls.note program) constants.charted;
  let env = Translate.env program (Scope.code program Main None) ~answer:true in
  Lambdas.fill env lambda Main [] e.at [ { Ast.it = Expression e; at = e.at } ];
  let not_there (name, at) = Diagnostic.error ~code:Unknown_name at (Printf.sprintf "unknown name '%s'" name) in
  match List.filter is_error (Scope.reports program) @ List.map not_there (Scope.unknown program) with
  | [] -> Ok (lambda, Scope.locations program, Scope.globals program, List.map snd globals)
  | errors -> Error errors

let run place (lambda, locations, global_names, values) =
  let program =
    { source_name = ""; locations; global_names; functions = []; main = lambda; ordered_keys = Tuple_space.no_key;
      inputs = []; vehicle_inputs = [];
      on_interrupt = None; recruits = false; goes_round = false; reads_sensors = false; reads_now = false;
      reads_time_of_day = false; asks_running = false; fences = Fences.none; place; begins = None } in
  let store = snd (List.fold_left (fun (i, store) x -> (i + 1, Store.set i x store)) (0, Store.empty) values) in
  let context : Code.context =
    { program; world = World.empty; allocation = Vehicle_map.empty; bound = []; held = lazy []; needed = lazy []; store;
      tuples = Tuples.empty Tuple_space.no_key; mode = Task_code; deeds = [] } in
  match Machine.run ~fuel context (Machine.call { lambda; captured = [||] } []) with
  | Decided (Finished x, _, _) -> `Value x
  | Decided (Faulted fault, _, _) -> `Fault (Fault.location program fault, fault.message)
  | Decided ((Exhausted | Left_off | Did _ | Waits _ | Halted _), _, _) | Open _ | Unclear _ -> `Not_known

let value constants (e : Ast.expression) =
  match unknown constants e with
  | Some why -> Error [ why ]
  | None ->
    let wrong at message = Error [ Diagnostic.error ~code:Bad_fence at message ] in
    let known code =
      match run constants.place code with
      | `Value x -> Ok x
      | `Fault (at, message) -> wrong (Option.value at ~default:e.at) message
      | `Not_known -> wrong e.at "this is not known before the program runs"
    in
    Result.bind (elaborated constants e) known

let chart constants (e : Ast.expression) =
  let path =
    match e.it, Chart_calls.file e with
    | Variable name, _ -> List.assoc_opt name constants.charted
    | _, Some (path, _) when not (String_set.mem Chart_calls.word constants.own) -> Some path
    | _, (Some _ | None) -> None
  in
  Option.bind path (fun path -> Result.to_option (constants.chart path))

let fault constants (e : Ast.expression) =
  match unknown constants e, lazy (elaborated constants e) with
  | Some _, _ | None, (lazy (Error _)) -> None
  | None, (lazy (Ok code)) -> (
      match run constants.place code with
      | `Fault (at, message) -> Some (Diagnostic.error ~code:Wrong_value (Option.value at ~default:e.at) message)
      | `Value _ | `Not_known -> None)

(* {1 Variables} *)

let function_names (ast : Ast.program) =
  List.filter_map (fun (s : Ast.statement) -> match s.it with Function { name; _ } -> Some name.it | _ -> None) ast

let of_program ~chart ~place ast =
  let once = Assigned.once (fun _ -> true) ast in
  let add constants (s : Ast.statement) =
    match s.it with
    | Parameter { name = { it = name; _ }; value = e; _ }
    | Define ({ it = name; _ }, Some e)
    | Assign { target = { it = Variable name; _ }; operator = None; value = e }
      when String_set.mem name once -> (
        match value constants e with
        | Ok x -> { constants with known = String_map.add name x constants.known }
        | Error _ -> constants)
    | _ -> constants
  in
  let own = String_set.union (Assigned.names ast) (String_set.of_list (function_names ast)) in
  List.fold_left add { known = String_map.empty; own; chart; place; charted = Chart_calls.assigned ast } ast
