open Dolphin_semantics
open Dolphin_environment

type t = { options : Clocked.options; vehicle : Core.vehicle }

let create options vehicle = { options; vehicle }
let vehicle c = c.vehicle
let may_do c s = Clocked.may_do c.options s c.vehicle

let is_heard c =
  let faults = c.options.environment.faults in
  (not (Faults.is_possible faults.loss))
  && not (Links.may_go (Durations.links_with faults c.options.durations) c.vehicle)

let is_newly_bound c (step : Clocked.step) =
  let is_mine : Effect.t -> bool = function Bind vs | Release vs -> List.mem c.vehicle vs | _ -> false in
  List.exists is_mine step.transition.effects

(* {1 Looks} *)

type range = { above : float; below : float }

let anything = { above = 0.; below = 1. }

let without_prefix prefix text =
  let n = String.length prefix in
  if String.length text > n && String.sub text 0 n = prefix then Some (String.sub text n (String.length text - n))
  else None

let without_suffix suffix text =
  let n = String.length suffix and all = String.length text in
  if all > n && String.sub text (all - n) n = suffix then Some (String.sub text 0 (all - n)) else None

(* A comparison of the battery with a number, as the semantics spells it: whether the battery is the lesser. *)
let comparison c text =
  let battery = World.spell Battery c.vehicle in
  let battery = if String.contains battery ' ' then "(" ^ battery ^ ")" else battery in
  let find (cut, around, is_less) =
    Option.bind (cut around text) (fun number -> Option.map (fun x -> (x, is_less)) (float_of_string_opt number)) in
  List.find_map find
    [ (without_prefix, battery ^ " < ", true); (without_prefix, battery ^ " > ", false);
      (without_suffix, " > " ^ battery, true); (without_suffix, " < " ^ battery, false) ]

let of_claim c text holds =
  match comparison c text with
  | Some (x, is_less) -> Some (if is_less = holds then { anything with below = x } else { anything with above = x })
  | None -> None

let both a b = { above = Float.max a.above b.above; below = Float.min a.below b.below }

let is_claim c : World.assumption -> bool = function
  | Claim (text, _) -> comparison c text <> None
  | Late _ | Missing _ | Sensed _ | Placed _ -> false

let turns c before (step : Clocked.step) =
  List.mem (Clocked.Task c.vehicle) step.fresh
  || may_do c before <> may_do c step.next
  || List.exists (is_claim c) step.transition.assumed

(* {1 What other looks would lead to} *)

let same (a : Clocked.step) (b : Clocked.step) =
  Label.equal a.transition.label b.transition.label && Option.map fst a.due = Option.map fst b.due
  && Clocked.equal a.next b.next

(* The steps of [s] where this claim holds, or does not. *)
let supposing c s text holds =
  let world = World.suppose [ Claim (text, holds) ] c.options.world in
  Clocked.all_steps { c.options with world } s

(* {2 Whether a look is one at what the battery shows now}

   An open value may be kept in a variable, and be compared later. It is compared too where the battery shows this or
   that number: one on each side of all that it is compared with. *)

let a_little = 1e-6

let is_now c s =
  let number : World.assumption -> float option = function
    | Claim (text, _) -> Option.map fst (comparison c text)
    | Late _ | Missing _ | Sensed _ | Placed _ -> None
  in
  let assumed steps = List.concat_map (fun (step : Clocked.step) -> step.transition.assumed) steps in
  let numbers = List.sort_uniq Float.compare (List.filter_map number (assumed (Clocked.all_steps c.options s))) in
  let is_clear x =
    let world = World.open_battery c.vehicle [ x ] c.options.world in
    not (List.exists (is_claim c) (assumed (Clocked.all_steps { c.options with world } s)))
  in
  List.for_all (fun x -> is_clear (x -. a_little) && is_clear (x +. a_little)) numbers

(* A step is reported once, with one of the looks that lead to it: the values that it shows are those that it needs. *)
let seen c s (step : Clocked.step) =
  let of_assumption found : World.assumption -> range = function
    | Claim (text, holds) -> (
        match of_claim c text holds with
        | Some range when not (List.exists (same step) (supposing c s text (not holds))) -> both found range
        | Some _ | None -> found)
    | Late _ | Missing _ | Sensed _ | Placed _ -> found
  in
  let range = List.fold_left of_assumption anything step.transition.assumed in
  if range = anything || is_now c s then range else anything

(* A claim that would let something happen at once does not hold as long as time passes. *)
let waited c (s : Clocked.state) =
  let of_step found (step : Clocked.step) =
    match step.transition.assumed with
    | [ Claim (text, holds) ] when not step.urgent -> (
        let is_it (other : Clocked.step) = other.urgent && other.transition.assumed = [] && same step other in
        match of_claim c text (not holds) with
        | Some { above; _ } when above > found && List.exists is_it (supposing c s text holds) -> above
        | Some _ | None -> found)
    | _ -> found
  in
  if not c.options.program.reads_sensors then 0.
  else
    let above = List.fold_left of_step 0. (Clocked.all_steps c.options s) in
    if above > 0. && is_now c s then above else 0.
