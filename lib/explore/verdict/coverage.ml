open Dolphin_semantics
open Core
module Sites = Set.Make (Int)

type t = { mutable reached : Sites.t; mutable lambdas : Sites.t }

let create () = { reached = Sites.empty; lambdas = Sites.empty }
let copy t = { t with reached = t.reached }

let add t t' =
  t.reached <- Sites.union t.reached t'.reached;
  t.lambdas <- Sites.union t.lambdas t'.lambdas

let run t (c : closure) = t.lambdas <- Sites.add c.lambda.id t.lambdas
let start t (p : platform_task) = t.reached <- Sites.add p.task_site t.reached

let is_run t id = Sites.mem id t.lambdas
let reach t site = t.reached <- Sites.add site t.reached
let reach_code t id = t.lambdas <- Sites.add id t.lambdas

let transition t (before : Configuration.t) (after : Transition.t) =
  let at m = t.reached <- Sites.add (Machine.site m) t.reached in
  match before.control, after.next.control with
  | Script _, (Script m | Waiting (m, _) | Executing (m, _)) -> at m
  | (Script _ | Waiting _ | Executing _ | Ended _), _ -> ()

type piece = { site : Core.site; what : string }

(* What stands at one place and has one name is one piece: [confirm] is two questions, as it asks again after an answer
   that is neither yes nor no. *)
module Pieces = Map.Make (struct
    type t = Dolphin_syntax.Location.t * string

    let compare = Stdlib.compare
  end)

let of_builtin = function
  | Execute | Execute_for _ -> Some "execute"
  | Release -> Some "release"
  | Ask -> Some "ask"
  | Message -> Some "message"
  | Pause -> Some "pause"
  | Post _ -> Some "post"
  | Set_connection_timeout -> Some "setConnectionTimeout"
  | _ -> None

(* The purpose of the code in an argument of this operation. *)
let code_of = function
  | Builtin Make_action -> Some "action"
  | Builtin Make_condition -> Some "condition"
  | Builtin Make_wait_for -> Some "waitFor"
  | Builtin (Make_until on_cut) -> Some (Dolphin_syntax.Print.until on_cut)
  | Builtin (Make_during on_cut) -> Some (Dolphin_syntax.Print.during on_cut)
  | Builtin Make_watch -> Some "onError"
  | Builtin (Make_repeat _) -> Some "repeat"
  | Make_branch -> Some "when"
  | _ -> None

let unreached t program =
  let missing = ref Pieces.empty and reached = ref Pieces.empty and walked = ref Sites.empty in
  let note site what is_reached =
    let key = (program.locations.(site), what) in
    if is_reached then reached := Pieces.add key site !reached
    else if not (Pieces.mem key !missing) then missing := Pieces.add key site !missing
  in
  let at_site site what = note site what (Sites.mem site t.reached) in
  (* [script] is whether the expression is the script's own, outside of any function or closure. *)
  let rec expression ~script e =
    let all = List.iter (expression ~script) in
    match e.node with
    | Constant (Task (Platform p)) -> at_site p.task_site "task"
    | Make_closure (lambda, _) -> code lambda
    | Apply (operation, arguments) ->
      let code_for what argument =
        match argument.node with
        | Make_closure (lambda, _) ->
          let what = if lambda.label = "assert" then "assert" else what in
          note lambda.lambda_site what (Sites.mem lambda.id t.lambdas)
        | Constant (Closure c) -> note c.lambda.lambda_site what (Sites.mem c.lambda.id t.lambdas)
        | _ -> ()
      in
      Option.iter (fun what -> List.iter (code_for what) arguments) (code_of operation);
      (match operation with
       | Builtin Platform_task | Build ((Imc_plan | Mission), _) -> at_site e.site "task"
       | Builtin b when script -> Option.iter (at_site e.site) (of_builtin b)
       | (Build (Pick, _) | Pick_if_any) when script -> at_site e.site "pick"
       | _ -> ());
      all arguments
    | _ -> all (Code_walk.parts e)
  and code lambda =
    if not (Sites.mem lambda.id !walked) then begin
      walked := Sites.add lambda.id !walked;
      expression ~script:false lambda.code
    end
  in
  expression ~script:true program.main.code;
  List.iter (fun (_, lambda) -> code lambda) program.functions;
  let is_unreached ((location, _) as key) _ =
    Dolphin_syntax.Location.file location <> Dolphin_syntax.Prelude.file && not (Pieces.mem key !reached)
  in
  let piece ((_, what), site) = { site; what } in
  List.sort Stdlib.compare (List.map piece (Pieces.bindings (Pieces.filter is_unreached !missing)))
