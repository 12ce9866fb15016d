open Dolphin_semantics
open Dolphin_environment
module Diagnostic = Dolphin_syntax.Diagnostic

(* Of 10,000 expressions at most; a silent one has as many. An editor asks after each change. *)
let most_steps = 500
let cost (t : Transition.t) = match t.label with Silent -> 50 | _ -> 1

(* [fail 'why'] is meant: the program may be right to end there. *)
let is_meant (p : Core.program) (fault : Fault.t) =
  let found = ref false in
  let look (e : Core.expression) =
    match e.node with
    | Apply (Builtin Fail, _) when e.site = fault.site -> found := true
    | _ -> () in
  Code_walk.iter look (Code_walk.pieces p);
  !found

(* The error of the program's text that [t] ends the run with. *)
let error_of ~own_fleet (p : Core.program) (t : Transition.t) =
  match t.label, t.next.control with
  | (Fault _ | Cannot_execute _ | Broken _), Ended (Failed ({ cause = Code | Assertion; _ } as fault))
    when not (is_meant p fault) -> Some fault
  | No_vehicles _, Ended (Failed fault) when own_fleet -> Some fault
  | _, _ -> None

let takes_vehicles (t : Transition.t) = match t.label with Bind _ -> true | _ -> false
let lacks_vehicles (t : Transition.t) = match t.label with No_vehicles _ -> true | _ -> false

(* The only transition that may come next, and whether it is the program's own: a pick of other vehicles is as good. *)
let next choices =
  let musts = Seq.filter (fun (c : Environment.choice) -> not (Environment.is_voluntary c.transition)) choices in
  match musts () with
  | Seq.Nil -> None
  | Seq.Cons (c, rest) ->
    let is_only = rest () = Seq.Nil || takes_vehicles c.transition in
    if is_only && c.transition.assumed = [] then Some c else None

let follow ~own_fleet (p : Core.program) scenario =
  let options = Scenario_world.environment ~answers:[] ~faults:Faults.none p scenario in
  (* They are voluntary: none is taken. *)
  let options = { options with inputs = [] } in
  let world = Scenario_world.world scenario in
  let rec go left ~certain configuration outside =
    if left <= 0 then None
    else
      match next (Environment.choices_on options p world outside configuration) with
      | None | (exception Environment.Unclear _) -> None
      | Some { transition; outside; on } -> (
          let certain = certain && on = None && not (takes_vehicles transition) in
          match error_of ~own_fleet p transition with
          | Some fault -> Some (certain && not (lacks_vehicles transition), fault)
          | None -> go (left - cost transition) ~certain transition.next outside)
  in
  go most_steps ~certain:true (Configuration.initial p) Environment.initial

let found ~own_fleet p scenario =
  match follow ~own_fleet p scenario with
  | None -> []
  | Some (certain, fault) ->
    let at = Option.value (Fault.location p fault) ~default:Dolphin_syntax.Location.none in
    if certain then [ Diagnostic.error ~code:Ends_here at fault.message ]
    else
      let hint = "found by following the program in its fleet, where no fault happens" in
      [ Diagnostic.warning ~hint Ends_here at ("a run ends here: " ^ fault.message) ]
