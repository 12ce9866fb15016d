open Dolphin_semantics
module Ast = Dolphin_syntax.Ast

type action =
  | Of_task of [ `Start | `Done | `Fail ] * string option * string option  (* the plan, the vehicle *)
  | Binds of string option
  | Says of string option
  | Posts of string option * Core.value option
  | Consumes of string option * Core.value option
  | Inputs of string option * Core.value option
  | Simple of string

type t = Action of action | State of Condition.t | Ended_now

let needs_action = function Action _ -> true | State _ | Ended_now -> false
let running = function Action _ | Ended_now -> [] | State condition -> Condition.running condition
let condition = function Action _ | Ended_now -> None | State condition -> Some condition

(* {1 Reading} *)

(* The name before the parenthesis, and the text inside. *)
let split text =
  match String.index_opt text '(' with
  | None -> (text, None)
  | Some i -> (String.trim (String.sub text 0 i), Some (String.sub text (i + 1) (String.length text - i - 2)))

let unquoted text =
  let n = String.length text in
  if n >= 2 && (text.[0] = '\'' || text.[0] = '"') && text.[n - 1] = text.[0] then String.sub text 1 (n - 2) else text

let names = function
  | None -> []
  | Some inner when String.trim inner = "" -> []
  | Some inner -> List.map (fun part -> unquoted (String.trim part)) (String.split_on_char ',' inner)

let simple = [ "timeout"; "execute"; "pick"; "ask"; "answer"; "pause"; "end"; "halt"; "error"; "interrupt" ]
let known =
  [ "start"; "done"; "fail"; "bind"; "message"; "post"; "consume"; "running"; "bound"; "poll"; "ended" ] @ simple

let literal (e : Ast.expression) : Core.value option =
  match e.it with
  | Integer n -> Some (Integer n)
  | Number x -> Some (Value.canonical (Number x))
  | Unary (Negate, { it = Integer n; _ }) -> Some (Integer (-n))
  | String s -> Some (String s)
  | Boolean b -> Some (Boolean b)
  | Null -> Some Null
  | _ -> None

(* [key], [key: value] or [key: _]. *)
let pair name inner =
  let whole = Printf.sprintf "%s(%s)" name inner in
  let wrong = Error (Printf.sprintf "%s takes a key, or a key and a plain value: %s(ready: 1)" name name) in
  match Dolphin_syntax.Parse.expression ~file:"formula" whole with
  | Ok { it = Call { arguments = [ Positional { it = Variable key | String key; _ } ]; _ }; _ } -> Ok (Some key, None)
  | Ok { it = Call { arguments = [ Named (key, { it = Wildcard; _ }) ]; _ }; _ } -> Ok (Some key.it, None)
  | Ok { it = Call { arguments = [ Named (key, e) ]; _ }; _ } -> (
      match literal e with Some x -> Ok (Some key.it, Some x) | None -> wrong)
  | Ok _ | Error _ -> wrong

let quoted names = String.concat ", " (List.map (fun name -> "'" ^ name ^ "'") names)

let of_string program text =
  let condition text = Result.map (fun c -> State c) (Condition.of_string program text) in
  let name, inner = split text in
  let task kind =
    match names inner with
    | [] -> Ok (Action (Of_task (kind, None, None)))
    | [ plan ] -> Ok (Action (Of_task (kind, Some plan, None)))
    | [ plan; vehicle ] -> Ok (Action (Of_task (kind, Some plan, Some vehicle)))
    | _ -> Error (Printf.sprintf "%s takes a plan and a vehicle: %s(survey1, noptilus-1)" name name)
  in
  let at_most_one build =
    match names inner with
    | [] -> Ok (Action (build None))
    | [ x ] -> Ok (Action (build (Some x)))
    | _ -> Error (Printf.sprintf "%s takes one argument" name)
  in
  let of_pair build =
    match inner with
    | None -> Ok (Action (build (None, None)))
    | Some inner -> Result.map (fun pair -> Action (build pair)) (pair name inner)
  in
  if text <> "" && text.[0] = '{' then condition (String.sub text 1 (String.length text - 2))
  else
    match name with
    | "start" -> task `Start
    | "done" -> task `Done
    | "fail" -> task `Fail
    | "bind" -> at_most_one (fun v -> Binds v)
    | "message" -> Ok (Action (Says (Option.map (fun inner -> unquoted (String.trim inner)) inner)))
    | "post" -> of_pair (fun (k, x) -> Posts (k, x))
    | "consume" -> of_pair (fun (k, x) -> Consumes (k, x))
    | "input" -> of_pair (fun (k, x) -> Inputs (k, x))
    | "running" | "bound" -> condition (Printf.sprintf "%s(%s)" name (quoted (names inner)))
    | "poll" -> condition text
    | "ended" when inner = None -> Ok Ended_now
    | name when List.mem name simple && inner = None -> Ok (Action (Simple name))
    | name when List.mem name simple || name = "ended" -> Error (Printf.sprintf "%s takes no arguments" name)
    | name ->
      let hint =
        match Dolphin_syntax.Diagnostic.suggest name known with
        | Some other -> Printf.sprintf "did you mean %s?" other
        | None -> Printf.sprintf "for a condition of the program write {%s}" text
      in
      Error (Printf.sprintf "unknown proposition '%s' (%s)" name hint)

(* {1 Asking} *)

let is wanted found = match wanted with None -> true | Some wanted -> String.equal wanted found

let contains inner text =
  let n = String.length inner in
  let rec is_from i =
    i + n <= String.length text && (String.equal (String.sub text i n) inner || is_from (i + 1)) in
  is_from 0

(* A message may print names; other texts depend on none. *)
let names p v =
  match p with
  | Action (Of_task (_, _, Some named) | Binds (Some named)) -> String.equal v named
  | Action (Posts (_, Some (String text)) | Consumes (_, Some (String text)) | Inputs (_, Some (String text))) ->
    String.equal v text
  | Action (Says (Some text)) -> contains v text
  | Action (Of_task _ | Binds None | Posts _ | Consumes _ | Inputs _ | Says None | Simple _) | Ended_now -> false
  | State condition -> List.mem v (Condition.vehicles condition)

type observed = { label : Label.t; effects : Effect.t list; ending : Configuration.ending option }

let observed (t : Transition.t) =
  let ending =
    match t.next.control with Ended ending -> Some ending | Script _ | Waiting _ | Executing _ -> None
  in
  { label = t.label; effects = t.effects; ending }

let deeds t =
  match t.label with
  | Did deed -> [ deed ]
  | Check deeds | Act deeds | Cut deeds -> deeds
  | _ -> []

let exists_pair key x pairs =
  let same (k, x') = is key k && match x with None -> true | Some x -> Value.compare x x' = 0 in
  List.exists same pairs

let holds_after_action action t =
  let task plan vehicle v name = is vehicle v && is plan name in
  match action, t.label with
  | Of_task (`Start, plan, vehicle), Start (v, name) -> task plan vehicle v name
  | Of_task (`Done, plan, vehicle), Done (v, name) -> task plan vehicle v name
  | Of_task (`Fail, plan, vehicle), Fail (v, name, _) -> task plan vehicle v name
  | Of_task _, _ -> false
  | Binds vehicle, Bind vs -> List.exists (is vehicle) vs
  | Binds _, _ -> false
  | Says text, _ -> List.exists (function Effect.Say said -> is text said | _ -> false) t.effects
  | Posts (key, x), _ -> List.exists (function Code.Posted ps -> exists_pair key x ps | _ -> false) (deeds t)
  | Consumes (key, x), _ -> List.exists (function Code.Consumed ps -> exists_pair key x ps | _ -> false) (deeds t)
  | Inputs (key, x), Input (k, y) -> exists_pair key x [ (k, y) ]
  | Inputs _, _ -> false
  | Simple "error", _ -> (match t.ending with Some (Failed _) -> true | Some _ | None -> false)
  | Simple "halt", _ -> (match t.ending with Some (Halted _) -> true | Some _ | None -> false)
  | Simple name, label -> (
      match label with
      | Time_out -> name = "timeout"
      | Execute -> name = "execute"
      | Pick _ -> name = "pick"
      | Ask _ -> name = "ask"
      | Answer _ -> name = "answer"
      | Pause _ -> name = "pause"
      | End -> name = "end"
      | Interrupt -> name = "interrupt"
      | _ -> false)

let holds_after p t = match p with Action action -> holds_after_action action t | State _ | Ended_now -> false

let holds_in program world p (c : Configuration.t) =
  match p with
  | Action _ -> Ok false
  | Ended_now -> Ok (Configuration.has_ended c)
  | State condition -> (
      match Condition.eval program world condition c with
      | Holds -> Ok true
      | Fails | Not_yet -> Ok false
      | Broken why -> Error why)
