open Dolphin_semantics
open Dolphin_trace
module Location = Dolphin_syntax.Location

type t = { what : string; at : Location.t option; lacking : string option }

(* {1 Words of the program} *)

let location (program : Core.program) site =
  if site >= 0 && site < Array.length program.locations then Some program.locations.(site) else None

let words text =
  String.concat " " (List.filter (fun word -> word <> "") (String.split_on_char ' ' (Phrase.one_line text)))

let text program ~source site =
  let of_location ({ start; stop } : Location.t) =
    match String.sub source start.pos_cnum (stop.pos_cnum - start.pos_cnum) with
    | text -> Some (words text)
    | exception Invalid_argument _ -> None
  in
  Option.bind (location program site) of_location

(* {1 Guards} *)

(* [a && b] is elaborated to [if a then not (not b) else false]. *)
let rec conjuncts (e : Core.expression) =
  match e.node with
  | Apply (Unary Not, [ { node = Apply (Unary Not, [ e ]); _ } ]) -> conjuncts e
  | If (a, b, { node = Constant (Boolean false); _ }) -> conjuncts a @ conjuncts b
  | Block [ e ] -> conjuncts e
  | _ -> [ e ]

(* A guard runs whenever it may hold, so it does not run long. Longer waits are not reported. *)
let fuel = 10_000

(* Whether [e] holds in the place of the code of [guard]; [None] if unknown. *)
let holds program world (s : Shared.t) (guard : Core.closure) e =
  let context : Code.context =
    { program; world; allocation = s.allocation; bound = s.bound; held = lazy []; needed = lazy [];
      store = s.store; tuples = s.tuples; mode = Task_code; deeds = [] }
  in
  let closure = { guard with lambda = { guard.lambda with code = e } } in
  match Machine.run ~fuel context (Machine.call closure []) with
  | Decided (Finished x, _, _) -> Some (Value.truth x)
  | Decided ((Exhausted | Did _ | Waits _ | Halted _ | Left_off | Faulted _), _, _) | Open _ | Unclear _ -> None

(* The shortest prefix of a conjunction that does not hold, by its last part: later parts lack the pairs that earlier
   ones consume. *)
let missing program world s (guard : Core.closure) =
  let all = guard.lambda.code in
  let both (a : Core.expression) b : Core.expression =
    { a with node = If (a, b, { a with node = Constant (Boolean false) }) } in
  let rec first beginning = function
    | [] -> None
    | e :: rest -> (
        let beginning = match beginning with None -> e | Some before -> both before e in
        match holds program world s guard beginning with
        | Some false -> Some e
        | Some true -> first (Some beginning) rest
        | None -> None)
  in
  match conjuncts all with [] | [ _ ] -> None | parts -> first None parts

let of_guard program ~source world s (guard : Core.closure) =
  let site = guard.lambda.code.site in
  let part = Option.bind (missing program world s guard) (fun (e : Core.expression) -> text program ~source e.site) in
  { what = Option.value (text program ~source site) ~default:guard.lambda.label;
    at = location program site;
    lacking = Option.map (fun text -> "not yet " ^ text) part }

(* {1 Questions} *)

type question = { at : Dolphin_syntax.Location.t option; is_confirm : bool }

let question program ~source c prompt =
  match List.find_opt (fun (q : Open_question.t) -> q.prompt = prompt) (Open_question.list c) with
  | Some { site; is_of_task; _ } ->
    let words = Option.value (text program ~source site) ~default:"" in
    { at = location program site; is_confirm = is_of_task || String.starts_with ~prefix:"confirm" words }
  | None -> { at = None; is_confirm = false }

(* {1 All of it} *)

let of_request world (request : Code.request) at =
  match request with
  | Pick pick ->
    let there = List.length (List.filter World.is_ready (World.vehicles world)) in
    { what = Format.asprintf "%a" Settings.pp_pick pick; at;
      lacking = Some (Phrase.count there "vehicle" ^ " in reach") }
  | Ask prompt -> { what = "an answer to " ^ words prompt; at; lacking = None }
  | Pause seconds -> { what = "a pause of " ^ Wording.duration seconds; at; lacking = None }
  | Host_call { subject; member; _ } ->
    { what = "the supplier: " ^ Machine.name_of_call ~subject ~member; at; lacking = None }
  | Execute _ -> { what = "a task"; at; lacking = None }

let list program ~source world (c : Configuration.t) =
  match c.control with
  | Script _ | Ended _ -> []
  | Waiting (m, request) -> [ of_request world request (location program (Machine.site m)) ]
  | Executing (_, r) ->
    let question : Residual.t -> t option = function
      | Confirm { prompt; site; _ } ->
        Some { what = "yes or no to " ^ words prompt; at = location program site; lacking = None }
      | Recruit { asked; site; _ } ->
        let what = Format.asprintf "a vehicle%a to recruit" Settings.pp_filter asked in
        Some { what; at = location program site; lacking = None }
      | _ -> None
    in
    let questions = Residual.fold_active (fun found r -> found @ Option.to_list (question r)) [] r in
    let add found (guard : Core.closure) =
      let is_of (g : Core.closure) = g.lambda.id = guard.lambda.id in
      if List.exists is_of found then found else guard :: found
    in
    let once = List.rev (List.fold_left add [] (Dolphin_runtime.Driver.guards r)) in
    questions @ List.map (of_guard program ~source world c.shared) once
