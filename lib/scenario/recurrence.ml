open Dolphin_syntax
open Dolphin_semantics
open Ast

let ( let* ) = Result.bind
let word = "assume"
let example = "as in assume eventually { battery('x8-02') > 0.8 }"
let error ?(hint = example) at format = Printf.ksprintf (fun m -> Error [ Diagnostic.error ~hint at m ]) format

(* {1 Vehicles}

   A vehicle that is named in quotes becomes a variable that no program can spell. *)

let of_vehicle = [ "battery"; "position"; "speed"; "connected"; "reading"; "eta" ]
let variable id = Printf.sprintf "vehicle '%s'" id

let rec named found (e : expression) : expression =
  match e.it with
  | Call { callee = { it = Variable f; _ } as callee; arguments = Positional { it = String id; at } :: others }
    when List.mem f of_vehicle ->
    found := (id, at) :: !found;
    let others = List.map (Operands.map_argument (named found)) others in
    { e with it = Call { callee; arguments = Positional { it = Variable (variable id); at } :: others } }
  | _ -> Operands.map (named found) e

let known vehicles (id, at) =
  let ids = List.map (fun (v : Entry.vehicle) -> v.id) vehicles in
  if List.mem id ids then Ok id
  else
    match Diagnostic.suggest id ids with
    | Some near -> error at "the fleet has no vehicle '%s'" id ~hint:(Printf.sprintf "did you mean '%s'?" near)
    | None -> error at "the fleet has no vehicle '%s'" id ~hint:(Printf.sprintf "it has %s" (String.concat ", " ids))

(* {1 The condition} *)

let empty_program = lazy (fst (Result.get_ok (Elaborate.program ~source_name:"fleet" [])))

(* [variables] are each a vehicle. *)
let checked variables (e : expression) =
  let here it = { it; at = e.at } in
  let pick x =
    let one = [ Positional (here (Integer 1)) ] in
    let settings = [ here (Expression (here (Call { callee = here (Variable "count"); arguments = one }))) ] in
    here (Assign { target = here (Variable x); operator = None; value = here (Builder (Pick, settings)) })
  in
  let condition = here (Assign { target = here (Variable "condition"); operator = None; value = e }) in
  let explained (d : Diagnostic.t) =
    match d.code with
    | Unknown_name ->
      { d with hint = Some "name a vehicle in quotes, or each one by a parameter: { v -> battery(v) > 0.8 }" }
    | _ -> d
  in
  match Elaborate.program ~source_name:"fleet" (List.map pick variables @ [ condition ]) with
  | Error found -> Error (List.map explained (List.filter (fun d -> d.Diagnostic.severity = Error) found))
  | Ok _ -> (
      match Elaborate.expression (Lazy.force empty_program) ~globals:variables e with
      | Ok closure -> Ok closure
      | Error message -> error e.at "%s" message)

let state (v : Entry.vehicle) : World.vehicle_state =
  let measured (name, xs) = (name, match xs with x :: _ -> x | [] -> 0.) in
  { id = v.id; kind = v.kind; payload = v.payload; position = v.position; depth = None; altitude = None;
    battery = (if v.tells_battery then Some v.battery else None); speed = Some 0.;
    readings = List.map measured v.shows; connected = true; unready = None; cruise = Some v.speed;
    drain = Some v.drain; progress = [] }

let world vehicles =
  let all = List.fold_left (fun w v -> World.add (state v) w) World.empty vehicles in
  World.at Any (List.fold_left Open_sensors.of_entry all vehicles)

let fuel = 100_000

(* The truth of [closure] by what it assumes; the variables are [values], in their order. *)
let cases world (closure : Core.closure) values =
  let program = Lazy.force empty_program in
  let shared = Shared.initial program in
  let first = Array.length program.global_names in
  let set (i, store) v = (i + 1, Store.set (first + i) (Core.Vehicles [ v ]) store) in
  let _, store = List.fold_left set (0, shared.store) values in
  let context : Code.context =
    { program; world; allocation = shared.allocation; bound = []; held = lazy []; needed = lazy []; store;
      tuples = shared.tuples; mode = Task_code; deeds = [] }
  in
  let truth ((stop : Machine.stop), _, (after : Code.context)) =
    match stop with
    | Finished x when after.deeds = [] ->
      Result.map_error (fun (f : Fault.t) -> f.message) (Result.map Value.truth (Reading.settled Fault.unknown_site x))
    | Faulted fault -> Error fault.message
    | Finished _ | Halted _ | Exhausted | Did _ | Waits _ | Left_off -> Error "a condition only looks"
  in
  match Decision.cases (Decision.map truth (Machine.run ~fuel context (Machine.call closure []))) with
  | Error fault -> Error fault.message
  | Ok cases ->
    let case (assumed, truth) = Result.map (fun truth -> (assumed, truth)) truth in
    Dolphin_results.Results.map case cases

(* A charge is a share: a battery shows nothing below 0 or above 1. *)
let beyond_charge vehicles closure values =
  let holds_at charge =
    let shows (v : Entry.vehicle) = { v with battery = charge; batteries = [ charge; charge ] } in
    match cases (world (List.map shows vehicles)) closure values with
    | Ok cases -> List.exists snd cases
    | Error _ -> true
  in
  let thousandth n = float_of_int n /. 1000. in
  not (List.exists holds_at (List.init 1001 thousandth))

let is_of_battery : World.assumption -> bool = function
  | Claim (text, _) ->
    let has part =
      let n = String.length part in
      let rec at i = i + n <= String.length text && (String.sub text i n = part || at (i + 1)) in
      at 0
    in
    has "battery(" && not (has " == ")
  | Sensed _ | Placed _ | Late _ | Missing _ -> false

let never at text = error at "this never holds: %s" text ~hint:"an assumption holds of some readings, and of others not"

let readings vehicles (e : expression) closure values =
  let world = world vehicles in
  match cases world closure values with
  | Error message -> error e.at "%s" message
  | Ok cases -> (
      let holding = List.filter_map (fun (assumed, holds) -> if holds then Some assumed else None) cases in
      let single = List.for_all (fun (assumed, _) -> List.length assumed = 1) cases in
      match List.concat holding with
      | _ when List.for_all (fun (assumed, _) -> assumed = []) cases ->
        error e.at "this depends on no reading that the fleet leaves open"
      | _ when not single -> error e.at "an assumption is one comparison with one sensor"
      | [] -> never e.at "no reading that the fleet lists satisfies it"
      | _ when List.length holding = List.length cases ->
        error e.at "this always holds: each reading that the fleet lists satisfies it"
      | a :: _ when is_of_battery a && beyond_charge vehicles closure values ->
        never e.at "a battery shows 0 to 1"
      | all -> Ok all)

(* {1 Entries} *)

let condition (c : closure) at =
  match c.body with
  | [ { it = Expression e; _ } ] -> Ok e
  | _ -> error at "an assumption is one condition"

let of_closure ~vehicles ~source ~at (c : closure) braces =
  let* e = condition c braces in
  let found = ref [] in
  let e' = named found e in
  let* _ = Dolphin_results.Results.map (known vehicles) (List.rev !found) in
  let ids = List.sort_uniq String.compare (List.map fst !found) in
  let one parameters values =
    let* closure = checked (parameters @ List.map variable ids) e' in
    Result.map (fun readings -> { Entry.source; readings; at }) (readings vehicles e closure (values @ ids))
  in
  match c.parameters with
  | None | Some [] -> Result.map (fun r -> [ r ]) (one [] [])
  | Some [ v ] -> (
      let each = List.map (fun (vehicle : Entry.vehicle) -> one [ v.it ] [ vehicle.id ]) vehicles in
      (* Some vehicles may not report it, or show nothing else. *)
      match List.filter_map Result.to_option each, each with
      | [], Error found :: _ -> Error found
      | found, _ -> Ok found)
  | Some (_ :: second :: _) -> error second.at "an assumption has one parameter, which stands for each vehicle"

let read ~vehicles at (arguments : argument list) =
  let braced = function [ Positional { it = Closure c; at } ] -> Some (c, at) | _ -> None in
  match arguments with
  | [ Positional ({ it = Call { callee = { it = Variable "eventually"; at = here }; arguments }; _ } as e) ] -> (
      match braced arguments with
      | None -> error here "eventually takes a condition in braces"
      | Some (c, braces) ->
        let whole = { e with it = Call { callee = { e with it = Variable word }; arguments = [ Positional e ] } } in
        of_closure ~vehicles ~source:(Format.asprintf "%a" Print.expression whole) ~at c braces)
  | [ Positional { it = Variable "eventually"; at } ] -> error at "eventually takes a condition in braces"
  | Positional { it = Call { callee = { it = Variable other; at }; _ }; _ } :: _
  | Positional { it = Variable other; at } :: _ -> error at "unknown assumption '%s': there is eventually" other
  | _ -> error at "assume takes eventually and a condition"
