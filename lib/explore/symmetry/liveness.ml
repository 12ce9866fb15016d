open Dolphin_semantics
open Core

(* Variables of the program by index, and locals of one call by slot. *)
module Variables = Set.Make (struct
    type t = [ `Global of int | `Local of int ]

    let compare = Stdlib.compare
  end)

type t = {
  called : Variables.t;  (* variables that may be read by code that is called or executed *)
  asked : Variables.t;  (* variables that conditions may read at any time *)
}

(* {1 Code that others call} *)

(* The globals that the code reads which [walk] goes through. *)
let read_by walk =
  let read = ref Variables.empty in
  let visit e = match e.node with Global i -> read := Variables.add (`Global i) !read | _ -> () in
  walk visit;
  !read

let of_program program ~asked =
  let called = read_by (fun visit -> Code_walk.iter_called visit program) in
  let own = read_by (fun visit -> Code_walk.iter visit (List.map (fun (c : closure) -> c.lambda) asked)) in
  { called; asked = (if asked = [] then Variables.empty else Variables.union called own) }

let may_call = function
  | Call _ | Method _ | Binary Parallel | Builtin (Execute | Execute_for _) -> true
  | Unary _ | Binary _ | Make_list | Make_map _ | Make_range _ | Concatenate | Element | Replace_element
  | Replace_member _ | Property _ | Builtin _ | Add_setting _ | Build _ | Pick_if_any
  | Make_branch | Make_recruit -> false

(* {1 What is read}

   [exits] has the variables that are live after an expression, by the way in which it is left: its value is used next,
   or it jumps. *)

type exits = { next : Variables.t; break : Variables.t; continue : Variables.t; return : Variables.t }

let over = { next = Variables.empty; break = Variables.empty; continue = Variables.empty; return = Variables.empty }

let rec fixpoint f live =
  let more = Variables.union live (f live) in
  if Variables.equal more live then live else fixpoint f more

(* The variables that are live before [e]. *)
let rec before called e exits =
  let before = before called in
  match e.node with
  | Constant _ -> exits.next
  | Local slot -> Variables.add (`Local slot) exits.next
  | Global i -> Variables.add (`Global i) exits.next
  | Set_local (slot, e) -> before e { exits with next = Variables.remove (`Local slot) exits.next }
  | Set_global (i, e) -> before e { exits with next = Variables.remove (`Global i) exits.next }
  | Make_closure (_, slots) -> List.fold_left (fun live slot -> Variables.add (`Local slot) live) exits.next slots
  | Apply (operation, es) -> all called es { exits with next = applied called operation exits.next }
  | If (test, yes, no) -> before test { exits with next = Variables.union (before yes exits) (before no exits) }
  | Block es -> all called es exits
  | While (test, body) -> loop called test body exits
  | For (slot, range, body) -> before range { exits with next = items called slot body exits }
  | Return e -> before e { exits with next = exits.return }
  | Break -> exits.break
  | Continue -> exits.continue

and all called es exits =
  List.fold_right (fun e live -> before called e { exits with next = live }) es exits.next

and applied called operation live = if may_call operation then Variables.union called live else live

and inside exits again = { exits with next = again; continue = again; break = exits.next }

(* Before the test is evaluated. *)
and loop called test body exits =
  let again live =
    before called test { exits with next = Variables.union exits.next (before called body (inside exits live)) }
  in
  fixpoint again Variables.empty

(* Before the next item is taken. *)
and items called slot body exits =
  let again live = Variables.remove (`Local slot) (before called body (inside exits live)) in
  fixpoint again exits.next

(* {1 Machines} *)

let locals_of live locals is_sought =
  let clear slot x = if is_sought x && not (Variables.mem (`Local slot) live) then Null else x in
  Array.mapi clear locals

let globals = Variables.filter (function `Global _ -> true | `Local _ -> false)

(* The stack, and the variables that are live once it has the value that it waits for, or gets a jump. *)
let rec stack called is_sought : Machine.frame list -> Machine.frame list * exits = function
  | [] -> ([], over)
  | frame :: below ->
    let below, exits = stack called is_sought below in
    let frame : Machine.frame =
      match frame with
      | Leave locals -> Leave (locals_of exits.next locals is_sought)
      | Next_item (slot, Items (xs, i), body) ->
        let gone j x = if j < i && is_sought x then Null else x in
        Next_item (slot, Items (Array.mapi gone xs, i), body)
      | Arguments _ | Assign_local _ | Assign_global _ | Choose _ | Rest _ | Loop_test _ | Loop_body _
      | Next_item (_, Counting _, _) | Iterate _ -> frame
    in
    (frame :: below, waiting called frame exits)

and waiting called (frame : Machine.frame) exits =
  let next live = { exits with next = live } in
  match frame with
  | Arguments { operation; remaining; _ } ->
    next (all called remaining (next (applied called operation exits.next)))
  | Assign_local slot -> next (Variables.remove (`Local slot) exits.next)
  | Assign_global i -> next (Variables.remove (`Global i) exits.next)
  | Choose (yes, no) -> next (Variables.union (before called yes exits) (before called no exits))
  | Rest es -> next (all called es exits)
  | Loop_test (test, body) ->
    let again = loop called test body exits in
    next (Variables.union exits.next (before called body (inside exits again)))
  | Loop_body (test, body) -> inside exits (loop called test body exits)
  | Next_item (slot, _, body) -> inside exits (items called slot body exits)
  | Leave _ ->
    let live = globals exits.next in
    { over with next = live; return = live }
  | Iterate _ -> next (Variables.union called exits.next)

let machine called is_sought (m : Machine.t) : Machine.t * Variables.t =
  let stack, exits = stack called is_sought m.stack in
  let live = match m.focus with Evaluate e -> before called e exits | Give _ -> exits.next in
  ({ m with locals = locals_of live m.locals is_sought; stack }, live)

let forget { called; asked } is_sought (c : Configuration.t) =
  let control, live =
    match c.control with
    | Script m ->
      let m, live = machine called is_sought m in
      (Configuration.Script m, live)
    | Waiting (m, request) ->
      let m, live = machine called is_sought m in
      (Waiting (m, request), live)
    | Executing (m, r) ->
      let m, live = machine called is_sought m in
      (Executing (m, r), Variables.union called live)
    | Ended ending -> (Ended ending, Variables.empty)
  in
  let clear store (i, x) =
    let is_read = Variables.mem (`Global i) live || Variables.mem (`Global i) asked in
    if is_sought x && not is_read then Store.set i Null store else store
  in
  let store = List.fold_left clear c.shared.store (Store.bindings c.shared.store) in
  { Configuration.control; shared = { c.shared with store } }
