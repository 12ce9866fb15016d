open Dolphin_semantics
open Dolphin_environment
open Core

(* Whether a pick may come, by the way in which an expression is left. *)
type exits = { next : bool; break : bool; continue : bool; return : bool }

let over = { next = false; break = false; continue = false; return = false }

(* The picks in code that others call, wherever it is called. *)
type called = { mutable picks : bool; mutable executes : bool }

let is_execute = function Builtin (Execute | Execute_for _) -> true | _ -> false
let is_pick = function Build (Pick, _) | Pick_if_any -> true | _ -> false

let called_code program =
  let found = { picks = false; executes = false } in
  let visit e =
    match e.node with
    | Apply (operation, _) ->
      if is_pick operation then found.picks <- true;
      if is_execute operation then found.executes <- true
    | _ -> ()
  in
  Code_walk.iter_called visit program;
  found

(* Unlike [||], whose right side may not be gone through. *)
let either a b = a || b

(* Whether a pick may come from the beginning of [e] on; [note ()] where one may come after an [execute]. *)
let rec before called note e exits =
  let before = before called note in
  match e.node with
  | Constant _ | Local _ | Global _ | Make_closure _ -> exits.next
  | Set_local (_, e) | Set_global (_, e) -> before e exits
  | Apply (operation, es) -> all called note es { exits with next = applied called note operation exits.next }
  | If (test, yes, no) -> before test { exits with next = either (before yes exits) (before no exits) }
  | Block es -> all called note es exits
  | While (test, body) ->
    let round again =
      let inside = { exits with next = again; continue = again; break = exits.next } in
      before test { exits with next = either (before body inside) exits.next }
    in
    round (round false)
  | For (_, range, body) ->
    let round again =
      either (before body { exits with next = again; continue = again; break = exits.next }) exits.next in
    before range { exits with next = round (round false) }
  | Return e -> before e { exits with next = exits.return }
  | Break -> exits.break
  | Continue -> exits.continue

and all called note es exits = List.fold_right (fun e next -> before called note e { exits with next }) es exits.next

and applied called note operation next =
  if is_execute operation then begin
    if next then note ();
    next
  end
  else if Liveness.may_call operation then begin
    if called.executes && (next || called.picks) then note ();
    next || called.picks
  end
  else next || is_pick operation

let may_follow (program : program) =
  let found = ref false in
  ignore (before (called_code program) (fun () -> found := true) program.main.code over : bool);
  !found

(* A lost vehicle may stay away from a [recruit] without end. *)
let forgetting (program : program) options =
  if may_follow program || program.recruits then options else Environment.forgetting_losses options
