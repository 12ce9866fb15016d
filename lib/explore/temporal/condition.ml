open Dolphin_semantics
module Ast = Dolphin_syntax.Ast

type question = Running of string * string option | Bound of string

type t = {
  text : string;
  closure : Core.closure;
  questions : (int * question) list;  (* by index of the global that stands for it *)
  names : int list;  (* the program's globals that it names *)
}

type answer = Holds | Fails | Not_yet | Broken of string

let to_string c = c.text
let closure c = c.closure

let vehicles c =
  let vehicle = function _, (Bound v | Running (_, Some v)) -> Some v | _, Running (_, None) -> None in
  List.filter_map vehicle c.questions

(* {1 Reading} *)

exception Wrong of string

let wrong format = Printf.ksprintf (fun why -> raise (Wrong why)) format

let question name arguments =
  match name, arguments with
  | "running", [ Ast.Positional { Ast.it = String plan; _ } ] -> Running (plan, None)
  | "running", [ Ast.Positional { it = String plan; _ }; Ast.Positional { it = String vehicle; _ } ] ->
    Running (plan, Some vehicle)
  | "bound", [ Ast.Positional { it = String vehicle; _ } ] -> Bound vehicle
  | "bound", _ -> wrong "bound takes the name of a vehicle, as in bound('noptilus-1')"
  | _, _ -> wrong "running takes the name of a plan, and of a vehicle: running('survey', 'noptilus-1')"

(* [e] with a variable for each question; [ask q] is the variable's name. *)
let rec replace ask (e : Ast.expression) : Ast.expression =
  match e.it with
  | Call { callee = { it = Variable (("running" | "bound") as name); _ } as callee; arguments } ->
    let it : Ast.expression_node =
      match ask name (fun () -> question name arguments) with
      | Some variable -> Variable variable
      | None ->
        let arguments = List.map (Dolphin_syntax.Operands.map_argument (replace ask)) arguments in
        Call { callee; arguments }
    in
    { e with it }
  | _ -> Dolphin_syntax.Operands.map (replace ask) e

let rec globals (e : Core.expression) =
  let own = match e.node with Global i | Set_global (i, _) -> [ i ] | _ -> [] in
  own @ List.concat_map globals (Code_walk.parts e)

let first_message : Dolphin_syntax.Diagnostic.t list -> string = function
  | d :: _ -> d.message
  | [] -> "it is not an expression"

let of_string (program : Core.program) text =
  let own = Array.length program.global_names in
  let questions = ref [] in
  let is_hidden name = List.mem_assoc name program.functions || Array.exists (String.equal name) program.global_names in
  let ask name question =
    if is_hidden name then None
    else begin
      questions := question () :: !questions;
      Some (Printf.sprintf "question %d" (List.length !questions))
    end
  in
  match Dolphin_syntax.Parse.expression ~file:"condition" text with
  | Error ds -> Error (first_message ds)
  | Ok e -> (
      match replace ask e with
      | exception Wrong why -> Error why
      | e ->
        let asked = List.mapi (fun i q -> (own + i, q)) (List.rev !questions) in
        let names = List.mapi (fun i _ -> Printf.sprintf "question %d" (i + 1)) asked in
        let condition (closure : Core.closure) =
          let names = List.sort_uniq Int.compare (globals closure.lambda.code) in
          { text; closure; questions = asked; names = List.filter (fun i -> i < own) names }
        in
        Result.map condition (Elaborate.expression program ~globals:names e))

(* {1 Asking} *)

let answer_to (c : Configuration.t) = function
  | Bound v -> List.mem v c.shared.bound
  | Running (plan, Some v) -> (
      match Vehicle_map.find_opt v c.shared.allocation with
      | Some p -> String.equal p.name plan
      | None -> false)
  | Running (plan, None) ->
    Vehicle_map.exists (fun _ (p : Core.platform_task) -> String.equal p.name plan) c.shared.allocation

let fuel = 100_000

let eval_in program world t (c : Configuration.t) =
  if List.exists (fun i -> Store.find i c.shared.store = None) t.names then Decision.Decided Not_yet
  else
    let set store (i, question) = Store.set i (Core.Boolean (answer_to c question)) store in
    let store = List.fold_left set c.shared.store t.questions in
    let context : Code.context =
      { program; world; allocation = c.shared.allocation; bound = c.shared.bound; held = lazy []; needed = lazy [];
        store; tuples = c.shared.tuples; mode = Task_code; deeds = [] }
    in
    let answer ((stop : Machine.stop), _, (after : Code.context)) =
      match stop with
      | Finished x when after.deeds = [] && Store.compare after.store store = 0 -> (
          match Reading.settled Fault.unknown_site x with
          | Ok x -> if Value.truth x then Holds else Fails
          | Error fault -> Broken fault.message)
      | Finished _ -> Broken "a condition may only look, and not do anything"
      | Faulted fault -> Broken fault.message
      | Halted _ -> Broken "a condition may not halt the program"
      | Exhausted -> Broken "it does not come to an end"
      | Did _ | Waits _ | Left_off -> Broken "a condition cannot wait"
    in
    Decision.map answer (Machine.run ~fuel context (Machine.call t.closure []))

let eval program world t c =
  match Decision.cases (eval_in program world t c) with
  | Ok ((_, answer) :: others) when List.for_all (fun (_, answer') -> answer' = answer) others -> answer
  | Ok _ -> Broken "it depends on sensor readings that may differ in one state"
  | Error fault -> Broken fault.message

let running t =
  List.filter_map (function _, Bound _ -> None | _, Running (plan, v) -> Some (plan, v)) t.questions

let only_shared t = running t = []
