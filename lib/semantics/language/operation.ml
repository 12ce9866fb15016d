open Dolphin_plans
open Core
open Code

let of_result = Procedures.of_result
let blocking = Procedures.blocking
let expected what x = of_result (Operators.expected what x)

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

let platform_task at plan = Task (Platform { name = Inline_plan.name plan; plan = Some plan; task_site = at })

let look_for context settings ~otherwise =
  match Settings.pick settings with
  | Ok pick -> blocking context "pick" (Pick { pick with otherwise })
  | Error fault -> Wrong_at fault

let recruit at settings code =
  match Settings.pick settings with
  | Ok pick -> Value (Task (Recruit { asked = pick.filter; code; site = at }))
  | Error fault -> Wrong_at fault

let build context at builder name arguments =
  match (builder : Dolphin_syntax.Ast.builder), arguments with
  | builder, [ Settings latest_first ] -> (
      let settings = List.rev latest_first in
      let value to_value = function Ok x -> Value (to_value x) | Error fault -> Wrong_at fault in
      match builder with
      | Pick -> look_for context settings ~otherwise:false
      | Imc_plan ->
        value
          (fun plan -> platform_task at (Inline_plan.Maneuvers plan))
          (Plan_builder.build ~name ~place:context.program.place at settings)
      | Mission ->
        value (fun mission -> platform_task at (Inline_plan.Mission mission)) (Mission_builder.build ~name at settings)
      | Pos -> value Fun.id (Settings.position at settings)
      | All_of -> value (fun branches -> Task (All_of branches)) (Settings.branches at settings)
      | One_of -> value (fun branches -> Task (One_of branches)) (Settings.branches at settings)
      | Recruit -> Wrong "a recruit has code")
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

(* Code that a map has under the name of the method. *)
let own_method subject name =
  match subject with
  | Map entries -> (match List.assoc_opt name entries with Some (Closure c) -> Some c | Some _ | None -> None)
  | _ -> None

let sense context name vs =
  match Reading.subject name with
  | Some subject -> Procedures.sense context subject vs
  | None -> of_result (Methods.property context.world (Vehicles vs) name)

let call_method context name names arguments =
  match with_named names arguments with
  | Host subject :: arguments -> host_call context subject name (Some arguments)
  | Closure c :: arguments when name = "call" -> Enter (c, arguments)
  | [ Vehicles vs ] when Reading.subject name <> None -> sense context name vs
  | subject :: arguments -> (
      match own_method subject name, Iteration.find subject name arguments with
      | Some closure, _ -> Enter (closure, arguments)
      | None, Some (iteration, closure, initial) -> Walk (iteration, closure, subject, initial)
      | None, None -> (
          match subject, Travel.quantity name, arguments with
          | Task (Platform p), Some quantity, [ Vehicles vs ] -> Procedures.travel context p quantity vs
          | Task (Platform p), None, [ Vehicles vs ] when name = "rest" -> Procedures.rest context p vs
          | _, _, _ -> of_result (Methods.call context.world subject name arguments)))
  | [] -> Wrong "a method needs something to be called on"

let apply_settled context at operation arguments =
  match operation, arguments with
  | Unary op, [ x ] -> of_result (Operators.unary op x)
  | Binary Parallel, [ (Vehicles _ as vs); Closure c ] -> Walk (Find_all, c, vs, [])
  | Binary op, [ x; y ] -> of_result (Operators.binary op x y)
  | Make_list, xs -> Value (List (Vector.of_list xs))
  | Make_map keys, arguments -> of_result (make_map keys arguments)
  | Make_range inclusive, [ first; last ] -> of_result (Operators.range ~inclusive first last)
  | Concatenate, parts -> Value (String (String.concat "" (List.map Value.to_string parts)))
  | Element, [ x; i ] -> of_result (Operators.element x i)
  | Replace_element, [ x; i; y ] -> of_result (Operators.replace_element x i y)
  | Replace_member k, [ x; y ] -> of_result (Operators.replace_element x (String k) y)
  | Property name, [ Host subject ] -> host_call context subject name None
  | Property (("position" | "battery") as name), [ Vehicles vs ] -> sense context name vs
  | Property name, [ x ] -> of_result (Methods.property context.world x name)
  | Call names, Closure c :: arguments -> Enter (c, with_named names arguments)
  | Call _, x :: _ -> expected "a function or closure to call" x
  | Method (name, names), (_ :: _ as arguments) -> call_method context name (None :: names) arguments
  | Builtin procedure, arguments -> Procedures.apply context at procedure arguments
  | Add_setting (name, names), arguments -> add_setting at name names arguments
  | Build (builder, name), arguments -> build context at builder name arguments
  | Pick_if_any, [ Settings latest_first ] -> look_for context (List.rev latest_first) ~otherwise:true
  | Make_recruit, [ Settings latest_first; Closure code ] -> recruit at (List.rev latest_first) code
  | Make_branch, arguments -> add_setting at "when" [ None; None ] arguments
  | ( ( Unary _ | Binary _ | Make_range _ | Element | Replace_element | Replace_member _ | Property _ | Call _
      | Method _ | Pick_if_any
      | Make_recruit ),
      _ ) -> Wrong "wrong number of operands"

let posts = function Pair_of _ -> true | Variable_of _ | Taken_pairs -> false

(* Operations that go through all parts of their arguments, to write or to keep them. *)
let takes_all_parts operation arguments =
  match operation, arguments with
  | (Concatenate | Builtin (Message | Halt | Assert | Fail | Ask | Make_confirm | Post _ | Consume _ | Poll _)), _
  | Method (("toString" | "join"), _), _ -> true
  | Builtin (Make_ensure forms), _ -> List.exists posts forms
  | Binary Add, [ x; y ] -> (match x, y with String _, _ | _, String _ -> true | _, _ -> false)
  | _, _ -> false

(* The text that they make is that of all strings in their arguments, and more. *)
let makes_text operation arguments =
  match operation with
  | Builtin (Post _ | Consume _ | Poll _ | Make_ensure _) -> false
  | _ -> takes_all_parts operation arguments

(* Whether a pair is there may depend on which part of a plan is left. The value of a pair that a pattern has chosen is
   in N: it equals itself, whatever is left, and only another pair may be the one that is taken. *)
let is_in_doubt context operation arguments =
  match operation with
  | Builtin (Consume (_ :: _ as keys) | Poll (_ :: _ as keys)) ->
    let in_doubt pairs =
      let is_chosen k x y = x == y && List.length (List.filter (fun (k', _) -> String.equal k' k) pairs) = 1 in
      let is_pair = function
        | _, Wildcard -> false
        | k, x ->
          let may_be y = (not (is_chosen k x y)) && Rest.may_equal (Value.canonical x) y in
          List.exists may_be (Tuples.values k context.tuples)
      in
      List.exists is_pair pairs
    in
    Result.fold (Procedures.given_pairs keys arguments) ~ok:in_doubt ~error:(fun _ -> false)
  | operation -> Rest.is_in_doubt operation arguments

let rec apply context at operation arguments =
  let kept = if takes_all_parts operation arguments then arguments else [] in
  match List.find_map (Value.excess ~most:Value.most_items) kept with
  | Some excess -> Wrong (Operators.too_large excess)
  | None when makes_text operation arguments && not (Value.have_characters_at_most Value.most_items arguments) ->
    of_result (Operators.too_long "a string")
  | None when List.exists Unknown.is arguments -> (
      match Unknown.apply operation arguments with
      | Gives x -> Value x
      | Needs u -> Wrong_at (Fault.unknown at u)
      | As_any -> apply_known context at operation arguments)
  | None -> apply_known context at operation arguments

and apply_known context at operation arguments =
  if not (World.is_open context.world) then apply_settled context at operation arguments
  else if context.program.reads_sensors && is_in_doubt context operation arguments then
    Unclear (Rest.in_doubt at)
  else if List.exists Reading.is_reading arguments then
    match Reading.apply ~begins:context.program.begins context.world at operation arguments with
    | Gives result -> of_result result
    | Asks question -> Asks (question, fun world -> apply { context with world } at operation arguments)
    | Unclear fault -> Unclear fault
    | As_any -> apply_settled context at operation arguments
  else apply_settled context at operation arguments
