open Dolphin_syntax
open Dolphin_semantics
module Reply = Dolphin_scenario.Reply

let ( let* ) = Result.bind
let usage = "give a key and a value, as in abort: true"

let why (d : Diagnostic.t) =
  match d.hint with Some hint -> Printf.sprintf "%s (%s)" d.message hint | None -> d.message

let value (e : Ast.expression) =
  match e.it with
  | Variable name when Answer.confirmation name <> None -> Ok (Core.Boolean (Answer.confirmation name = Some true))
  | Variable name -> Error (Printf.sprintf "'%s' is not a value: put a text in quotes, '%s'" name name)
  | _ -> (
      match Reply.data e with
      | Ok [ x ] -> Ok x
      | Ok _ -> Error "one value is posted at a time"
      | Error d -> Error (why d))

let pair : Ast.argument -> (string * Core.value, string) result = function
  | Named (key, e) -> Result.map (fun x -> (key.it, x)) (value e)
  | Positional { it = Variable key; _ } -> Ok (key, Boolean true)
  | Positional _ | Keyed _ -> Error usage

let rec pairs = function
  | [] -> Ok []
  | argument :: rest ->
    let* first = pair argument in
    Result.map (List.cons first) (pairs rest)

let read text =
  match Parse.program ~file:"input" ("post(" ^ text ^ "\n)") with
  | Ok [ { it = Expression { it = Call { callee = { it = Variable "post"; _ }; arguments = _ :: _ as found }; _ }; _ } ]
    -> pairs found
  | Ok _ | Error _ -> Error usage

let declared (program : Core.program) ~questions key =
  let keys = program.inputs @ questions in
  if List.mem key keys then Ok ()
  else
    let known =
      match Diagnostic.suggest key keys, keys with
      | Some near, _ -> Printf.sprintf ": did you mean '%s'?" near
      | None, [] -> ", nor any other"
      | None, keys -> ", only " ^ String.concat ", " (List.map (Printf.sprintf "'%s'") keys)
    in
    Error (Printf.sprintf "the program declares no input '%s'%s" key known)

let is_of_kind (program : Core.program) key (x : Core.value) =
  match x with Vehicles [ _ ] -> true | _ -> not (List.mem key program.vehicle_inputs)

let fits (program : Core.program) key (x : Core.value) =
  if not (is_of_kind program key x) then
    Error (Printf.sprintf "the input '%s' takes a vehicle, as in %s: vehicles('x8-02')" key key)
  else if Answer.confirmation_of_value x <> None || List.mem key program.inputs then Ok ()
  else Error (Printf.sprintf "the question '%s' takes yes or no" key)
